// SPDX-License-Identifier: Apache-2.0
#include "runtime/problem/result.hpp"

namespace regulus {

const char* name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return "NO SINGULARITY";
    case Verdict::kSingularity:
      return "SINGULARITY";
    case Verdict::kPossibleProblem:
      return "POSSIBLE PROBLEM";
  }
  return "";
}

const char* describe(Reason reason) noexcept {
  switch (reason) {
    case Reason::kAllBoxesCertified:
      return "every box is certified";
    case Reason::kOppositeSigns:
      return "two points with determinants of opposite signs, joined within the motion";
    case Reason::kSmallDeterminant:
      return "a point whose determinant is at most the threshold";
    case Reason::kAlwaysSingular:
      return "the determinant vanishes identically, by exact algebra";
    case Reason::kWidth:
      return "a box at the minimum width could not be decided";
    case Reason::kUncertainty:
      return "at one pose the uncertain quantities alone defeat the test";
    case Reason::kUndefined:
      return "an expression is undefined in or near a pose of the motion";
    case Reason::kBoxBudget:
      return "the limit on the number of boxes was reached";
    case Reason::kTimeBudget:
      return "the time limit was reached";
    case Reason::kInterrupted:
      return "the search was interrupted";
    case Reason::kMemory:
      return "memory is exhausted";
    case Reason::kBadProblem:
      return "the problem cannot be searched";
    case Reason::kLostRank:
      return "a point where the matrix loses rank, by exact algebra";
    case Reason::kNullVector:
      return "a pose at which the matrix loses rank and its null vector, both enclosed";
    case Reason::kStalled:
      return "boxes are certified so slowly that the search would not end";
    case Reason::kEmptyVariety:
      return "no pose remains: the constraints exclude every pose of the motion";
    case Reason::kSeemsSingular:
      return "the determinant seems to vanish at every pose, but that was not proved";
  }
  return "";
}

const char* name(Rule rule) noexcept {
  switch (rule) {
    case Rule::kOutside:
      return "outside";
    case Rule::kHMatrix:
      return "h-matrix";
    case Rule::kMeanValue:
      return "mean-value";
    case Rule::kSecondOrder:
      return "second order";
    case Rule::kOrthants:
      return "orthants";
    case Rule::kDeterminant:
      return "determinant";
    case Rule::kElimination:
      return "elimination";
    case Rule::kRohn:
      return "rohn";
    case Rule::kClosedForm:
      return "closed-form";
    case Rule::kFilter:
      return "filter";
    case Rule::kMultiprecision:
      return "multiprecision";
    case Rule::kWitness:
      return "witness";
    case Rule::kBlocked:
      return "blocked";
  }
  return "";
}

}  // namespace regulus
