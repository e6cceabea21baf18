// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where a matrix is nearest to losing rank, if nothing could be proved. For a matrix with
// more rows than columns this is always so: no sign changes where it loses rank.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/analysis/lost_twist.hpp"
#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline analysis {

/// A point of the variety and the twists lost there. Approximate, without a claim.
struct LeastSingular {
  std::vector<Interval> variables;  ///< thin
  std::vector<Interval> pose;       ///< thin; empty if it has no value
  Degeneracy degeneracy;
};

/// Returns the point of the least singular value found by descents, first from the middle of `box`,
/// then from other places of the variety until a singular value is negligible; nullopt if J⁻¹ had
/// no value at any of them.
[[nodiscard]] std::optional<LeastSingular> approx_least_singular(const PreparedSearch& preparation,
                                                                 std::span<const Interval> box);

/// The same from the blocking box of a search that proved nothing; nullopt after other searches,
/// and if the matrix is undefined.
[[nodiscard]] std::optional<LeastSingular> nearest_singular(const PreparedSearch& preparation,
                                                            const Result& result);

}  // namespace regulus::analysis
