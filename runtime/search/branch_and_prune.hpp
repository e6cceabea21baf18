// SPDX-License-Identifier: Apache-2.0
// The loop of Algorithm 1, lines 3–28, both for searches by several threads and for checks in a
// control loop.
#pragma once

#include <algorithm>
#include <vector>

#include "runtime/evaluation/bisector.hpp"
#include "runtime/evaluation/decisions.hpp"
#include "runtime/search/frontier.hpp"

namespace regulus::detail {

/// Takes boxes from a frontier, round by round, and puts the halves of boxes that must be split
/// back on it.
///
/// The conclusions from the batches of a round are drawn in two passes, so that a singularity found
/// in any of them ends the search before boxes are split. Undecided boxes are split last to first,
/// so that the first is on top again.
///
/// `Steps` defines the parts that differ between searches:
///   bool begin_round()             before each round: false ends the search
///   std::size_t decide_round()     takes boxes from the frontier, decides them; number of batches
///   Decisions& batch(i)
///   bool conclude(Decisions&)      conclusions from the leaves of a batch; false ends this pass
///   bool goes_on()                 false ends the second pass: nothing is split any more
///   void give_back(Decisions&)     the batch was not decided
///   void settle(Decisions&, lane)  a box that is a leaf; in the second pass
///   bool splits(const OpenBox&)    false: the search must stop, the box stays open
///   BoxId number(parent, variable, at)  announces a split; the number of the first half
///   void lose(first, second)       memory is exhausted: the halves are not on the frontier
///   void end_round()
/// After construction it allocates nothing, except for the growth of the frontier.
template <typename Steps>
class BranchAndPrune {
 public:
  /// All must outlive this object.
  BranchAndPrune(Steps& steps, Frontier& frontier, const Bisector& bisector, std::size_t variables)
      : steps_(steps), frontier_(frontier), bisector_(bisector), upper_(variables) {}

  void run() noexcept {
    while (!frontier_.empty() && steps_.begin_round()) {
      const std::size_t batches = steps_.decide_round();
      for (std::size_t i = 0; i < batches; ++i)
        if (!steps_.conclude(steps_.batch(i))) break;
      for (std::size_t i = batches; i-- > 0 && steps_.goes_on();) settle_rest(steps_.batch(i));
      steps_.end_round();
    }
  }

 private:
  void settle_rest(Decisions& batch) noexcept {
    if (!batch.decided) return steps_.give_back(batch);
    for (std::size_t lane = batch.count(); lane-- > 0 && steps_.goes_on();) {
      if (batch.decision[lane].kind == Decision::Kind::kLeaf)
        steps_.settle(batch, lane);
      else if (steps_.splits(batch.open(lane)))
        split(batch, lane);
    }
  }

  void split(Decisions& batch, std::size_t lane) noexcept {
    const OpenBox& parent = batch.open(lane);
    const std::uint32_t variable = batch.decision[lane].variable;
    const std::span<Interval> lower = batch.box_of(lane);
    const Halves halves = *bisect(lower[variable]);
    const BoxId id = steps_.number(parent, variable, halves.left.hi);
    std::copy(lower.begin(), lower.end(), upper_.begin());
    lower[variable] = halves.left;
    upper_[variable] = halves.right;
    const OpenBox first{id, parent.depth + 1, lower};
    const OpenBox second{id + 1, parent.depth + 1, upper_};
    if (!frontier_.push_halves(first, bisector_.approx_relative_width(first.box), second,
                               bisector_.approx_relative_width(second.box)))
      steps_.lose(first, second);
  }

  Steps& steps_;
  Frontier& frontier_;
  const Bisector& bisector_;
  std::vector<Interval> upper_;
};

}  // namespace regulus::detail
