// SPDX-License-Identifier: Apache-2.0
// A search of a box of unknowns for solutions of equations that are in no list. PROOF.md, "All solutions
// of equations".
#pragma once

#include <functional>

#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/verify.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

[[nodiscard]] bool is_in(std::span<const Interval> box, std::span<const Interval> other);
[[nodiscard]] bool is_in_one(std::span<const Interval> box, const std::vector<Box>& others);
[[nodiscard]] bool are_disjoint(std::span<const Interval> a, std::span<const Interval> b);

/// Parts of the range: a box that is narrower may be shown to hold another solution.
inline constexpr double kNarrowPart = 0x1p-16;

/// What a search shows while solutions are followed.
inline constexpr const char* kFollowed = "each solution is regular, and within a line,";

class BoxSearch {
 public:
  /// Searches for solutions of the equations in question.closure at any place of `places`. `also`: more
  /// expressions that are 0 at each solution. All but `also` and `places` must outlive this object.
  BoxSearch(Question& question, const std::vector<NodeId>& also, Box places, WorkClock& clock,
            const Options& options, Verification& result);

  [[nodiscard]] BranchTest& test() noexcept { return test_; }
  void set_range(Box range) { range_ = std::move(range); }

  /// Shows that a box holds no solution.
  [[nodiscard]] bool is_empty(const Box& box);
  /// Returns a box about `middle` in which exactly one solution is, at each place: the widest that was
  /// found, at least as wide as `least`. nullopt: none was found.
  [[nodiscard]] std::optional<Box> reach_of(const std::vector<double>& middle,
                                            const std::vector<double>& least);

  /// Narrows a box to a part with all of its solutions that are not known; false: there are none.
  using Rest = std::function<bool(Box&)>;

  /// Shows that all solutions in the range are known. Throws Unfinished if it cannot: "it was not shown that", `what`.
  /// `look_for_other` is called for a box that has become narrow, and may throw.
  void search(const Rest& has_rest, const std::function<void(const Box&)>& look_for_other,
              const char* what = "there is no other solution");

  /// "x = 1.5, y = 2".
  [[nodiscard]] std::string place_of(const Box& box) const;

 private:
  [[nodiscard]] double width(std::size_t i) const { return range_[i].hi - range_[i].lo; }
  [[nodiscard]] double part(const Box& box, std::size_t i) const {
    return (box[i].hi - box[i].lo) / width(i);
  }
  [[nodiscard]] bool is_left(Box& box, const Rest& has_rest);
  [[nodiscard]] std::size_t widest_of(const Box& box) const;
  [[nodiscard]] std::size_t to_halve(const Box& box, std::size_t widest) const;
  [[noreturn]] void give_up(const Box& box, const char* what) const;

  const Question& q_;
  const Box places_;
  WorkClock& clock_;
  const Options& options_;
  Verification& result_;
  BranchTest test_;
  std::vector<NodeId> conditions_;  ///< each is 0 at a solution
  Evaluation evaluation_;
  Box range_;
};

}  // namespace regulus::verifier
