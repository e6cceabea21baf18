// SPDX-License-Identifier: GPL-3.0-or-later
// A small linear program, in doubles: it proposes forces and directions, and proves nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace regulus::detail {

/// The greatest s with normal_i·z + s ≤ bound_i for all i and some z.
struct GreatestSlack {
  std::vector<double> z;
  double s = 0;
  std::vector<double> multipliers;  ///< λ ≥ 0: Σλ_i = 1, Σλ_i·normal_i = 0, s = Σλ_i·bound_i
};

/// Solves the dual program by the simplex method with Bland's rule.
///
/// Shape     normals row-major, bounds.size() × dimension; dimension may be 0.
/// Ensures   approximate values; nullopt if s is not bounded, or rounding errors prevent an answer.
[[nodiscard]] std::optional<GreatestSlack> approx_greatest_slack(std::span<const double> normals,
                                                                 std::size_t dimension,
                                                                 std::span<const double> bounds);

}  // namespace regulus::detail
