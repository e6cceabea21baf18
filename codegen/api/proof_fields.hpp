// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/api/margin.hpp"
#include "codegen/certificate/proof_status.hpp"
#include "codegen/report/report_text.hpp"

namespace regulus::inline api {

/// Adds what a certificate says to a report and to a finding; the finding's `json` is the report.
template <class Finding>
void add_proof(const ProofStatus& proof, nlohmann::ordered_json report, Finding& finding) {
  proof.add_to(report);
  finding.report += proof.line();
  if (proof.is_written()) finding.certificate = proof.path();
  finding.no_certificate = proof.obstacle();
  finding.json = report_text(report, 2);
}

/// Adds the proofs of a component's ends to a finding; nothing if none were wanted.
template <class Finding>
void add_ends(const EndProofs& proofs, const std::string& component, Finding& finding) {
  if (!proofs.are_wanted()) return;
  for (const EndProof* end : {&proofs.safe(), &proofs.singular()})
    finding.certificates.push_back({component, end == &proofs.safe(), end->file,
                                    end->file.empty() ? end->words : std::string()});
}

}  // namespace regulus::api
