// SPDX-License-Identifier: Apache-2.0
// The same as checker.h, for C++: it says what a check is.
#pragma once

#include <span>
#include <vector>

#include "regulus/interval/interval.hpp"
#include "regulus/kernel/abi.hpp"
#include "regulus/search/branch_and_prune.hpp"
#include "regulus/search/decider.hpp"
#include "regulus/search/frontier.hpp"
#include "regulus/search/result.hpp"
#include "regulus/search/witness_search.hpp"

namespace regulus {

struct Check {
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  unsigned boxes = 0;  ///< evaluated
  /// SINGULARITY: one point of the proof after the other, each as many intervals as the kernel has
  /// variables. POSSIBLE PROBLEM: the box that could not be decided; none for kBadProblem and
  /// kEmptyVariety. Valid until the next check.
  std::span<const Interval> places;
};

/// Decides pieces of one variety, over and over.
class Checker {
 public:
  static constexpr unsigned kMaxBoxes = 1U << 20;

  /// `ranges`: of all variables of the kernel; the pieces lie in those of the motion parameters.
  ///
  /// Requires  1 ≤ max_boxes ≤ kMaxBoxes; the kernel, and what it points to, outlives this object.
  /// Errors    std::invalid_argument; std::bad_alloc: max_boxes + 1 boxes have to fit in memory.
  Checker(const regulus_kernel& kernel, std::span<const Interval> ranges, unsigned max_boxes,
          double alpha = 0.0);
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;

  /// Neither allocates nor locks; evaluates at most max_boxes boxes.
  ///
  /// Shape     `piece`: a range for each motion parameter.
  /// Ensures   as solve() in regulus/search/solver.hpp, for that piece and the whole ranges of the
  ///           uncertain quantities. kBadProblem: the piece does not lie in the ranges. Gives up at
  ///           the first box that cannot be decided. What it says follows from the piece alone. One
  ///           thread at a time; the caller's floating-point environment is kept.
  [[nodiscard]] Check check(std::span<const Interval> piece) noexcept;

  [[nodiscard]] const regulus_kernel& kernel() const noexcept { return *problem_.kernel; }

 private:
  [[nodiscard]] Check search(std::span<const Interval> piece) noexcept;
  void load_frontier(std::span<const Interval> piece) noexcept;
  friend class BranchAndPrune<Checker>;
  [[nodiscard]] bool begin_round() noexcept;
  [[nodiscard]] std::size_t decide_round() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t) noexcept { return batch_; }
  [[nodiscard]] bool conclude(Decisions& batch) noexcept;
  [[nodiscard]] bool goes_on() const noexcept { return !stopped_; }
  void give_back(Decisions&) noexcept {}  // every batch is decided
  void settle(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool splits(const OpenBox&) const noexcept { return true; }
  [[nodiscard]] BoxId number(const OpenBox&, std::uint32_t, double) const noexcept { return 0; }
  void lose(const OpenBox& first, const OpenBox& second) noexcept;
  void end_round() const noexcept {}
  void stop_at(Reason reason, std::span<const Interval> box) noexcept;

  const Problem problem_;
  const Settings settings_;
  const RowStructure structure_;
  const unsigned max_boxes_;
  Decider decider_;
  Decisions batch_;
  WitnessSearch witness_;
  Frontier frontier_;
  BranchAndPrune<Checker> loop_;
  AdaptiveThreshold threshold_;
  std::vector<Interval> half_, places_;
  Check check_;  ///< the one under way
  unsigned boxes_ = 0;
  bool stopped_ = false;    ///< check_ is the answer
  bool certified_ = false;  ///< a test vouches for some box that the constraints do not exclude
};

}  // namespace regulus
