// SPDX-License-Identifier: Apache-2.0
// The terms of the sums of second_order_lanes.hpp: middles and distances of enclosures, and factors
// that give upper bounds of sums of magnitudes.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/pack_lanes.hpp"
#include "runtime/regularity/second_order_plan.hpp"

namespace regulus::detail::second_order {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

/// For one term, a few, or any sum of magnitudes here; the last factor costs 2^-35 of the sum.
inline constexpr double kOneTerm = raise_factor(1);
inline constexpr double kFewTerms = raise_factor(16);
inline constexpr double kManyTerms = raise_factor(std::size_t{1} << 16);

REGULUS_LANE_INLINE Pack product_ru(const Pack& a, const Pack& b) noexcept {
  return raised(a * b, kOneTerm);
}

struct Middle {
  Pack middle, distance;  ///< distance: rounded once
};

REGULUS_LANE_INLINE Middle middle_of(ConstIntervalVector intervals, unsigned at) noexcept {
  const Pack lo = Pack::load(intervals.data() + 2 * at * kLanes);
  const Pack hi = Pack::load(intervals.data() + (2 * at + 1) * kLanes);
  const Pack half = Pack::of(0.5);
  const Pack middle = half * lo + half * hi;
  return {middle, larger(hi - middle, middle - lo)};
}

/// Returns the largest |x|.
REGULUS_LANE_INLINE Pack largest_of(ConstIntervalVector intervals, unsigned at) noexcept {
  return larger(magnitude(Pack::load(intervals.data() + 2 * at * kLanes)),
                magnitude(Pack::load(intervals.data() + (2 * at + 1) * kLanes)));
}

REGULUS_LANE_INLINE void clear(PackArray array, unsigned count) noexcept {
  for (unsigned e = 0; e < count; ++e) array.put(e, Pack::of(0.0));
}
REGULUS_LANE_INLINE void raise(PackArray array, unsigned count, double factor) noexcept {
  for (unsigned e = 0; e < count; ++e) array.put(e, raised(array[e], factor));
}
REGULUS_LANE_INLINE void add_squares(const SecondOrderPlan& plan, const PlanRange& range,
                                     PackArray x, PackArray sums) noexcept {
  for (unsigned k = range.begin; k < range.end; ++k)
    sums.add_fused(plan.entries[k].column, x[k - range.begin], x[k - range.begin]);
}
/// Computes upper bounds of the square roots of sums of squares.
REGULUS_LANE_INLINE void take_roots(PackArray x, unsigned count) noexcept {
  for (unsigned e = 0; e < count; ++e)
    x.put(e, raised(square_root(raised(x[e], kFewTerms)), kOneTerm));
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::second_order
