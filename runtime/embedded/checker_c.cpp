// SPDX-License-Identifier: Apache-2.0
// Implements checker.h by checker.hpp.
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

#include "runtime/embedded/checker.h"
#include "runtime/embedded/checker.hpp"

struct regulus_checker {
  regulus_checker(const regulus_kernel& kernel, std::span<const regulus::Interval> ranges,
                  unsigned max_boxes, double alpha)
      : checker(kernel, ranges, max_boxes, alpha),
        piece(kernel.motion_variables),
        places(4 * std::size_t{kernel.variables}) {}

  regulus::Checker checker;
  std::vector<regulus::Interval> piece;
  std::vector<double> places;
};

namespace {

using regulus::Reason;
using regulus::Verdict;

regulus_check_verdict word_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return REGULUS_CHECK_NO_SINGULARITY;
    case Verdict::kSingularity:
      return REGULUS_CHECK_SINGULARITY;
    case Verdict::kPossibleProblem:
      break;
  }
  return REGULUS_CHECK_POSSIBLE_PROBLEM;
}

regulus_check_reason word_of(Reason reason) noexcept {
  switch (reason) {
    case Reason::kAllBoxesCertified:
      return REGULUS_CHECK_ALL_CERTIFIED;
    case Reason::kOppositeSigns:
      return REGULUS_CHECK_OPPOSITE_SIGNS;
    case Reason::kSmallDeterminant:
      return REGULUS_CHECK_SMALL_DETERMINANT;
    case Reason::kWidth:
      return REGULUS_CHECK_WIDTH;
    case Reason::kUncertainty:
      return REGULUS_CHECK_UNCERTAINTY;
    case Reason::kUndefined:
      return REGULUS_CHECK_UNDEFINED;
    case Reason::kBoxBudget:
      return REGULUS_CHECK_BOX_BUDGET;
    case Reason::kEmptyVariety:
      return REGULUS_CHECK_NO_POSE;
    case Reason::kAlwaysSingular:  // a check never returns these
    case Reason::kTimeBudget:
    case Reason::kInterrupted:
    case Reason::kMemory:
    case Reason::kBadProblem:
    case Reason::kSeemsSingular:
    case Reason::kStalled:
    case Reason::kLostRank:
    case Reason::kNullVector:
      break;
  }
  return REGULUS_CHECK_BAD_RANGES;
}

/// Copies bounds unchanged: the checker refuses bounds in the wrong order.
void load(std::span<regulus::Interval> into, const double* lower, const double* upper) noexcept {
  for (std::size_t k = 0; k < into.size(); ++k) into[k].lo = lower[k], into[k].hi = upper[k];
}

void fill(regulus_check_report& report, regulus_checker& checker,
          const regulus::Check& check) noexcept {
  const std::size_t variables = checker.checker.kernel().variables;
  for (std::size_t k = 0; k < check.places.size(); ++k) {
    checker.places[2 * k] = check.places[k].lo;
    checker.places[2 * k + 1] = check.places[k].hi;
  }
  report = {word_of(check.verdict), word_of(check.reason), check.boxes,
            static_cast<unsigned>(check.places.size() / variables), checker.places.data()};
}

}  // namespace

regulus_checker* regulus_checker_new(const regulus_kernel* kernel, const double* lower,
                                     const double* upper, double alpha, unsigned max_boxes,
                                     char* fault, std::size_t fault_size) {
  try {
    if (kernel == nullptr || lower == nullptr || upper == nullptr)
      throw std::invalid_argument("the kernel or a list of bounds is null");
    std::vector<regulus::Interval> ranges(kernel->variables);
    load(ranges, lower, upper);
    return std::make_unique<regulus_checker>(*kernel, ranges, max_boxes, alpha).release();
  } catch (const std::bad_alloc&) {
    if (fault != nullptr) std::snprintf(fault, fault_size, "memory is exhausted");
  } catch (const std::exception& error) {
    if (fault != nullptr) std::snprintf(fault, fault_size, "%s", error.what());
  }
  return nullptr;
}

void regulus_checker_free(regulus_checker* checker) { delete checker; }

regulus_check_verdict regulus_check(regulus_checker* checker, const double* lower,
                                    const double* upper, regulus_check_report* report) {
  load(checker->piece, lower, upper);
  const regulus::Check check = checker->checker.check(checker->piece);
  if (report != nullptr) fill(*report, *checker, check);
  return word_of(check.verdict);
}
