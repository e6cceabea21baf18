// SPDX-License-Identifier: GPL-3.0-or-later
// Where a matrix comes nearest to losing rank, when nothing could be proved. Of a matrix with more
// rows than columns nothing can ever be: no sign changes where it loses rank.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/analysis/lost_twist.hpp"
#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline analysis {

/// A point of the variety and what is lost there. Approximate: nothing is claimed.
struct LeastSingular {
  std::vector<Interval> variables;  ///< thin
  std::vector<Interval> pose;       ///< thin; empty where it has no value
  Degeneracy degeneracy;
};

/// The point of the least singular value that was met on ways downhill, from the middle of
/// `box` and then from other places of the variety until a singular value is negligible; nullopt if
/// J⁻¹ had no value at any of them.
[[nodiscard]] std::optional<LeastSingular> approx_least_singular(const PreparedSearch& preparation,
                                                                 std::span<const Interval> box);

/// The same from the blocking box of a search that proved nothing; nullopt after others, and where
/// the matrix is undefined.
[[nodiscard]] std::optional<LeastSingular> nearest_singular(const PreparedSearch& preparation,
                                                            const Result& result);

}  // namespace regulus::inline analysis
