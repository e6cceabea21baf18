// SPDX-License-Identifier: Apache-2.0
// The same as checker.h, for C++. The contracts of a check are here.
#pragma once

#include <memory>
#include <span>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

struct Check {
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  unsigned boxes = 0;  ///< evaluated
  /// SINGULARITY: the points of the proof, one after the other; each has one interval for each
  /// variable of the kernel. POSSIBLE PROBLEM: the box that could not be decided; none for
  /// kBadProblem and kEmptyVariety. Valid until the next check.
  std::span<const Interval> places;
};

namespace detail {
class PieceSearch;
}  // namespace detail

/// Decides pieces of one variety, one after the other.
class Checker {
 public:
  static constexpr unsigned kMaxBoxes = 1U << 20;

  /// `ranges`: of all variables of the kernel; the pieces lie in those of the motion parameters.
  ///
  /// Requires  1 ≤ max_boxes ≤ kMaxBoxes; the kernel and all it points to outlive this object.
  /// Errors    std::invalid_argument; std::bad_alloc: the boxes that may wait together must fit
  ///           in memory, at most max_boxes + 9 and some thousand of them.
  Checker(const regulus_kernel& kernel, std::span<const Interval> ranges, unsigned max_boxes,
          double alpha = 0.0);
  Checker(Checker&&) noexcept;
  Checker& operator=(Checker&&) noexcept;
  ~Checker();

  /// Does not allocate or lock; evaluates at most max_boxes boxes.
  ///
  /// Shape     `piece`: a range for each motion parameter.
  /// Ensures   as solve() in runtime/search/solver.hpp, for that piece and the whole ranges of the
  ///           uncertain quantities. kBadProblem: the piece does not lie in the ranges. Gives up at
  ///           the first box that cannot be decided. The answer depends on the piece alone. One
  ///           thread at a time; the caller's floating-point environment is kept.
  [[nodiscard]] Check check(std::span<const Interval> piece) noexcept;

  [[nodiscard]] const regulus_kernel& kernel() const noexcept;

 private:
  std::unique_ptr<detail::PieceSearch> search_;
};

}  // namespace regulus
