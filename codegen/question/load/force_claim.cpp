// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/force_claim.hpp"

namespace regulus {

const char* name(ForceClaim claim) noexcept {
  switch (claim) {
    case ForceClaim::kFeasible:
      return "feasible";
    case ForceClaim::kInfeasible:
      return "infeasible";
    case ForceClaim::kUndecided:
      return "undecided";
    case ForceClaim::kOutside:
      return "outside";
  }
  return "";
}

const char* name(FeasibilityVerdict verdict) noexcept {
  switch (verdict) {
    case FeasibilityVerdict::kFeasible:
      return "FEASIBLE";
    case FeasibilityVerdict::kInfeasible:
      return "INFEASIBLE";
    case FeasibilityVerdict::kPossibleProblem:
      return "POSSIBLE PROBLEM";
  }
  return "";
}

}  // namespace regulus
