// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/certificate/verification_report.hpp"

#include <nlohmann/json.hpp>

namespace regulus::inline certificate {
namespace {

const char* json_name(verifier::Outcome outcome) {
  return outcome == verifier::Outcome::kVerified   ? "verified"
         : outcome == verifier::Outcome::kRejected ? "rejected"
                                                   : "unfinished";
}

}  // namespace

nlohmann::ordered_json json_verification(const VerificationRequest& request,
                                         const Verified& verified) {
  const verifier::Verification& v = verified.verification;
  nlohmann::ordered_json report = {{"outcome", json_name(v.outcome)},
                                   {"reason", v.reason},
                                   {"claim", v.claim},
                                   {"model", v.model},
                                   {"model_sha256", v.sha256},
                                   {"motion", v.motion},
                                   {"shards", v.shards},
                                   {"leaves", v.leaves},
                                   {"boxes", v.boxes},
                                   {"note", v.note}};
  report["certificate"] = request.path;
  report["model_file"] = nullptr;
  if (!request.model.empty()) report["model_file"] = request.model;
  report["differences"] = verified.differences;
  report["numbers_compared"] = v.numbers;
  report["uncompared"] = v.uncompared;
  return report;
}

}  // namespace regulus::certificate
