// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where a matrix is nearest to losing rank: if nothing could be proved, and if it is almost
// singular at a pose although it is not. For a matrix with more rows than columns nothing can be
// proved where it loses rank: no sign changes there.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/analysis/lost_twist.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// A point of the variety and the twists lost there. Approximate, without a claim.
struct LeastSingular {
  std::vector<Interval> variables;  ///< thin
  std::vector<Interval> pose;       ///< thin; empty if it has no value
  Degeneracy degeneracy;
  /// |det| of the balanced matrix (balanced_matrix.hpp), whose rows have length 1 at most, so that
  /// it is a part of what they allow (Hadamard). Known after NO SINGULARITY.
  std::optional<double> share{};
};

/// A smaller part of Hadamard's bound is worth a line: a number of the model that is rounded, or a
/// tolerance that is left out, may be larger than this distance.
inline constexpr double kAlmostSingular = 1e-6;

/// Returns the point of the least singular value found by descents, first from the middle of `box`,
/// then from other places of the variety until a singular value is negligible; nullopt if J⁻¹ had
/// no value at any of them.
[[nodiscard]] std::optional<LeastSingular> approx_least_singular(const PreparedSearch& preparation,
                                                                 std::span<const Interval> box);

/// The same from the blocking box of a search that proved nothing. After NO SINGULARITY, with less
/// effort, a pose at which a square matrix is almost singular. nullopt if there is none, after other
/// searches, and if the matrix is undefined.
[[nodiscard]] std::optional<LeastSingular> nearest_singular(const PreparedSearch& preparation,
                                                            const Result& result);

}  // namespace regulus::detail
