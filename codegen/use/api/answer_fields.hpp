// SPDX-License-Identifier: GPL-3.0-or-later
// What the values of this interface take from an answer.
#pragma once

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/api/margin.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {

/// Returns the services of a program: no terminal, names without dashes. Throws UsageError for a
/// shard size that has no meaning.
[[nodiscard]] inline Services services_of(const std::string& certificate, std::uint64_t shard_size,
                                          const std::atomic<bool>* interrupt) {
  if (shard_size > 0 && certificate.empty())
    throw UsageError("shard_size: there is no proof to cut; name a file for the certificate, too");
  if (shard_size > 0 && shard_size < format::kLeastShardSize)
    throw UsageError("shard_size: found " + std::to_string(shard_size) + ", expected " +
                     std::to_string(format::kLeastShardSize) + " bytes at least");
  Services services;
  services.certificate = certificate;
  services.shard_size = shard_size;
  services.interrupt = interrupt;
  return services;
}

/// `told`: the lines of Services::on_line.
template <class Finding>
void set_reports(const Answer& answer, const std::string& told, Finding& finding) {
  Facts facts;
  answer.tell(facts);
  finding.report = told + facts.text() + answer.about_files();
  finding.json = report_text(facts.report(), 2);
}

template <class Finding>
void set_proof(const ProofStatus& proof, Finding& finding) {
  if (proof.is_written()) finding.certificate = proof.path();
  finding.no_certificate = proof.obstacle();
}

template <class Finding>
void set_ends(const std::vector<ProofOfEnd>& proofs, Finding& finding) {
  for (const ProofOfEnd& end : proofs)
    finding.certificates.push_back({end.component, end.is_safe_end, end.file, end.obstacle});
}

}  // namespace regulus::detail
