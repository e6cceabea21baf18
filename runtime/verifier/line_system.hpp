// SPDX-License-Identifier: Apache-2.0
// The equations of a closure along a line of places. PROOF.md, "SINGULARITY of a closure".
#pragma once

#include <span>

#include "runtime/verifier/branch_test.hpp"

namespace regulus::verifier {

/// A line of places: part t of it is at from + t·(to − from). Expressions without variables.
struct PlaceLine {
  std::vector<NodeId> from, to;  ///< by variable; `to` is kNoNode: the variable stays
};

/// The equations in t and the unknowns, which are coordinates 0, 1, …, n of a curve. One coordinate is
/// the variable, and the others, in order, are the unknowns.
class LineSystem {
 public:
  LineSystem(const Question& question, const PlaceLine& line, std::size_t coordinate);
  LineSystem(const LineSystem&) = delete;
  LineSystem& operator=(const LineSystem&) = delete;

  [[nodiscard]] BranchTest& test() noexcept { return test_; }
  [[nodiscard]] bool is_along_line() const noexcept { return coordinate_ == 0; }
  /// Splits a point of the curve into the variable and the unknowns, or puts it together.
  [[nodiscard]] Interval variable_of(const std::vector<Interval>& point) const {
    return point[coordinate_];
  }
  [[nodiscard]] SolutionBox unknowns_of(const std::vector<Interval>& point) const;
  [[nodiscard]] std::vector<Interval> point_of(Interval variable,
                                               const SolutionBox& unknowns) const;

 private:
  const std::size_t coordinate_;
  Question question_;
  BranchTest test_;
};

/// The equations, Φ_p·v and n·v − 1, without a variable; the unknowns are t, those of Φ, and v.
[[nodiscard]] Question bordered_along(const Question& question, const PlaceLine& line,
                                      std::span<const double> normal);

}  // namespace regulus::verifier
