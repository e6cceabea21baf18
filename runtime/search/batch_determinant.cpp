// SPDX-License-Identifier: Apache-2.0
// The determinant over a whole box.
#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

/// Two enclosures of the same numbers share them, so that both hold at once.
Interval both(Interval x, Interval y) noexcept { return intersect(x, y).value_or(x); }

/// Expansion, far more work, adds little where elimination finds its pivots.
Interval enclose_both_ways(const IntervalMatrix& M) noexcept {
  const Interval eliminated = enclose_determinant_by_elimination(M);
  const bool expand = M.n <= kMaxExpansion && certain_sign(eliminated) == 0;
  return expand ? both(eliminated, enclose_determinant(M)) : eliminated;
}

}  // namespace

/// det A directly, and as det(K·A)/det K: near the identity the entries depend on each other less.
std::optional<Interval> Batch::determinant(std::size_t lane, bool scaled) noexcept {
  LaneMask defined = certain_posed() & 1U << lane;
  const double* matrix = product({}, defined);
  if (defined == 0) return std::nullopt;
  Interval result = enclose_both_ways(interval_lane(matrix, columns_, lane));
  LaneMask left = defined;
  const double* KA = product({ProductForm::Side::kLeft, false}, left);
  const Interval K = left != 0 ? preconditioner_determinant(lane) : Interval(0.0);
  if (left != 0 && !contains_zero(K))
    result = both(result, enclose_both_ways(interval_lane(KA, columns_, lane)) / K);
  return scaled ? result * row_scale(lane) : result;
}

}  // namespace regulus
