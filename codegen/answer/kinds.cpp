// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/kinds.hpp"

#include <algorithm>

namespace regulus::detail {

Word word_of(Verdict verdict) noexcept {
  return verdict == Verdict::kNoSingularity ? Word::kProved
         : verdict == Verdict::kSingularity ? Word::kRefuted
                                            : Word::kOpen;
}

Word word_of(FeasibilityVerdict verdict) noexcept {
  return verdict == FeasibilityVerdict::kFeasible     ? Word::kProved
         : verdict == FeasibilityVerdict::kInfeasible ? Word::kRefuted
                                                      : Word::kOpen;
}

std::string missing_proof(const ProofStatus& proof) {
  return proof.is_wanted() && !proof.is_written() && !proof.is_lost() ? proof.obstacle() : "";
}

std::string missing_proof(const std::vector<ProofOfEnd>& proofs) {
  const bool has_file =
      std::ranges::any_of(proofs, [](const ProofOfEnd& proof) { return !proof.file.empty(); });
  return proofs.empty() || has_file ? "" : proofs.front().obstacle;
}

Word CheckAnswer::word() const { return word_of(result.verdict); }
std::string CheckAnswer::headline() const { return name(result.verdict); }

Word PavingAnswer::word() const { return word_of(result.verdict); }
std::string PavingAnswer::headline() const { return name(result.verdict); }

Word LoadAnswer::word() const { return word_of(verdict); }
std::string LoadAnswer::headline() const { return name(verdict); }

}  // namespace regulus::detail
