// SPDX-License-Identifier: Apache-2.0
// The roots of a system that are proved to be there, found along paths from those of another one.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/solutions/complex_root.hpp"
#include "runtime/solutions/path_tracker.hpp"

namespace regulus::detail {

struct RootQuery {
  /// Its last equations are patch·z = 1, for each group of unknowns of the homotopy.
  const PolynomialSystem& system;
  std::span<const double> patch;
  std::function<bool(const RootBox&)> counts;  ///< which roots are wanted
};

/// Follows each start, along another arc as long as fewer roots than starts are known and the last arc
/// led to new ones.
///
/// Ensures   pairwise disjoint boxes, each with one simple root, which counts.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] std::vector<RootBox> follow_roots(const Homotopy& homotopy,
                                                std::span<const std::vector<Complex>> starts,
                                                const RootQuery& query);

}  // namespace regulus::detail
