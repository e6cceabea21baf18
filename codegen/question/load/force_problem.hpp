// SPDX-License-Identifier: GPL-3.0-or-later
// The limits and the loads of a question about forces, without the pose.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// A ball about 0 in some components of the wrench.
struct LoadBall {
  std::vector<std::size_t> members;
  Interval radius;  ///< encloses it
};

/// Forces f, one for each row of J⁻¹, hold a wrench w if (J⁻¹)ᵀf = w. Those of motors have limits, those
/// of passive constraints are free.
///
/// The load is the set of all sums of a point of the convex hull of `corners` and a point of each
/// ball. The forces may depend on the load. The loads that some forces within the limits hold at a
/// pose are the image of a box under a linear map, hence a convex set. So if each corner is held,
/// so is every load of their hull.
struct ForceProblem {
  std::size_t rows = 0, columns = 0;
  std::vector<Interval> certain;               ///< by row: forces in it are within the limits
  std::vector<Interval> possible;              ///< by row: forces outside it are beyond a limit
  std::vector<bool> is_free;                   ///< by row: there is no limit; both are everything
  std::vector<std::vector<Interval>> corners;  ///< each encloses a wrench
  std::vector<LoadBall> balls;
};

/// A load that varies in more components is refused, because its corners would be too many.
inline constexpr std::size_t kMostLoadRanges = 10;

/// Returns forces that are certainly within the limits, by row, of the rows that have limits: those of
/// motors come first. Throws UsageError if the model gives none.
[[nodiscard]] std::vector<Interval> certain_limits(const Model& model);

/// Throws    UsageError if the model gives no limits of force, or the load has too many ranges.
/// Rounding  `certain` inward, all else outward.
[[nodiscard]] ForceProblem force_problem(const Model& model, const VectorSet& load);

/// Returns the question about the matrix J⁻¹: the row scales are in the entries, and there is no
/// threshold.
[[nodiscard]] Request with_scaled_rows(Request request);

}  // namespace regulus::detail
