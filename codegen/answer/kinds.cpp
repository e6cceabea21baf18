// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/kinds.hpp"

namespace regulus {

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

Word CheckAnswer::word() const { return word_of(result.verdict); }
std::string CheckAnswer::headline() const { return name(result.verdict); }

Word PavingAnswer::word() const { return word_of(result.verdict); }
std::string PavingAnswer::headline() const { return name(result.verdict); }

Word LoadAnswer::word() const { return word_of(verdict); }
std::string LoadAnswer::headline() const { return name(verdict); }

}  // namespace regulus
