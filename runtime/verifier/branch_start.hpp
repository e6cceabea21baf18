// SPDX-License-Identifier: Apache-2.0
// Encloses where a branch of a closure starts: the place, and the one configuration there. FORMAT.md,
// "Closures".
#pragma once

#include "runtime/verifier/branch_test.hpp"

namespace regulus::verifier {

/// Returns the value of each variable at the start: of a parameter that of its line `start`, of the
/// others the middle of their range.
[[nodiscard]] std::vector<NodeId> start_values(Question& question);

/// Encloses the place of the start in the ranges, `variety.outer`. Throws Rejection or Unfinished.
[[nodiscard]] Box start_place(Question& question, const Variety& variety);

/// The values of the lines `unknown`.
class StartBox {
 public:
  /// Throws Rejection or Unfinished.
  explicit StartBox(const Question& question);

  /// Shows that exactly one configuration at the place is within the radius, and encloses it to a
  /// small part of `scale`, by unknown. Throws Unfinished.
  [[nodiscard]] SolutionBox only_solution(BranchTest& test, const Box& place,
                                          std::span<const double> scale) const;
  [[nodiscard]] const std::vector<double>& radius() const noexcept { return inner_; }

 private:
  std::vector<double> middle_, outer_, inner_;  ///< the radius, from outside and inside
};

}  // namespace regulus::verifier
