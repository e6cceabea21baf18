// SPDX-License-Identifier: GPL-3.0-or-later
// What the values of this interface take from an answer.
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/use/api/margin.hpp"

namespace regulus {

/// Returns the services of a program: no terminal, names without dashes.
[[nodiscard]] inline Services services_of(const std::string& certificate,
                                          const std::atomic<bool>* interrupt) {
  Services services;
  services.certificate = certificate;
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

}  // namespace regulus
