// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/verification_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace regulus::detail {
namespace {

const char* json_name(verifier::Outcome outcome) {
  return outcome == verifier::Outcome::kVerified   ? "verified"
         : outcome == verifier::Outcome::kRejected ? "rejected"
                                                   : "unfinished";
}

}  // namespace

nlohmann::ordered_json json_verification(const VerificationRequest& request,
                                         const verifier::Verification& v) {
  nlohmann::ordered_json report = {{"outcome", json_name(v.outcome)},
                                   {"reason", v.reason},
                                   {"claim", v.claim},
                                   {"bound", v.bound},
                                   {"model", v.model},
                                   {"model_sha256", v.sha256},
                                   {"motion", v.motion},
                                   {"shards", v.shards},
                                   {"leaves", v.leaves},
                                   {"boxes", v.boxes},
                                   {"note", v.note}};
  const bool is_paving =
      std::ranges::any_of(v.paved, [](std::uint64_t count) { return count > 0; });
  const bool is_of_branch = v.links > 0 || v.paved.back() > 0;
  const std::size_t words = v.paved.size() - (is_of_branch ? 0 : 1);
  for (std::size_t i = 0; is_paving && i < words; ++i)
    report["paved"][verifier::kPavedWords[i]] = v.paved[i];
  report["certificate"] = request.path;
  report["model_file"] = nullptr;
  if (!request.model.empty()) report["model_file"] = request.model;
  report["differences"] = v.differences;
  report["numbers_compared"] = v.numbers;
  return report;
}

}  // namespace regulus::detail
