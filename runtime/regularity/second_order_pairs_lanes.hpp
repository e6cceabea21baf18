// SPDX-License-Identifier: Apache-2.0
// The terms of second order in two variables at a time; the first part of second_order_lanes.hpp.
#pragma once

#include "runtime/regularity/pack_lanes.hpp"
#include "runtime/regularity/second_order_plan.hpp"
#include "runtime/regularity/second_order_terms_lanes.hpp"

namespace regulus::detail::second_order {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

class PairBounding {
 protected:
  REGULUS_LANE_INLINE PairBounding(const SecondOrderPlan& plan, const SecondOrderInput& input,
                                   const SecondOrderWork& work) noexcept
      : plan_(plan), in_(input), w_(work), n_(plan.columns_of_A) {}

  [[nodiscard]] REGULUS_LANE_INLINE Pack radius(unsigned variable) const noexcept {
    return Pack::load(in_.radius.data() + variable * kLanes);
  }

  [[nodiscard]] REGULUS_LANE_INLINE PackArray derivative(unsigned wide) const noexcept {
    return PackArray{w_.D.x} + wide * n_ * n_;
  }

  /// Returns true if D_pD_q is not 0.
  [[nodiscard]] REGULUS_LANE_INLINE bool moves(const SecondOrderPlan::Pair& pair) const noexcept {
    return pair.q < plan_.moving;
  }

  /// Returns the rows of D_p from row i on.
  [[nodiscard]] REGULUS_LANE_INLINE SparseRows rows_of(unsigned p, unsigned i) const noexcept {
    const PlanRange& columns = plan_.wide[p].columns;
    return {derivative(p) + i * n_, n_, plan_.columns + columns.begin, columns.size()};
  }

  /// Adds Σ_pq of r_pr_q·|B_pq − D_pD_q − D_qD_p|, or r_p²·|½B_pp − D_pD_p|, to P. A block of P
  /// stays in registers over all pairs.
  REGULUS_LANE_INLINE void add_pairs() noexcept {
    if (!plan_.keeps_shares)
      for (unsigned k = 0; k < plan_.pairs; ++k)
        if (!moves(plan_.pair[k])) add_fixed_pair(plan_.pair[k]);
    for_each_block(
        n_, n_,
        [&]<unsigned kRows, unsigned kAtOnce>(unsigned i, unsigned j)
            __attribute__((always_inline)) {
              Block<kRows, kAtOnce> P;
              P.read(PackArray{w_.magnitude_of_B.x} + (i * n_ + j), n_);
              for (unsigned k = 0; k < plan_.pairs; ++k)
                if (plan_.keeps_shares || moves(plan_.pair[k])) add_pair(plan_.pair[k], k, i, j, P);
              P.write(PackArray{w_.P.x} + (i * n_ + j), n_);
            });
  }

 private:
  /// Adds r_pr_q·|B_pq| or ½r_p²·|B_pp| to the sum of magnitudes, where P begins.
  REGULUS_LANE_INLINE void add_fixed_pair(const SecondOrderPlan::Pair& pair) noexcept {
    const Pack weight =
        product_ru(radius(plan_.wide[pair.p].variable), radius(plan_.wide[pair.q].variable));
    const Pack part = weight * Pack::of(pair.p == pair.q ? 0.5 : 1.0);
    for (unsigned k = pair.second.begin; k < pair.second.end; ++k) {
      const SecondOrderPlan::Entry& entry = plan_.entries[k];
      PackArray{w_.magnitude_of_B.x}.add_fused(entry.place, largest_of(in_.second, entry.at), part);
    }
  }

  template <unsigned kRows, unsigned kAtOnce>
  REGULUS_LANE_INLINE void add_pair(const SecondOrderPlan::Pair& pair, unsigned index, unsigned i,
                                    unsigned j, Block<kRows, kAtOnce>& P) noexcept {
    const SecondOrderPlan::Wide &p = plan_.wide[pair.p], &q = plan_.wide[pair.q];
    const Pack weight = product_ru(radius(p.variable), radius(q.variable));
    const bool curved = pair.second.size() > 0;
    Block<kRows, kAtOnce> sum;
    if (curved) read_second(pair, weight, i, j, sum);
    if (moves(pair)) {
      sum.add_product(rows_of(pair.p, i), derivative(pair.q) + j, n_);
      if (pair.p != pair.q) sum.add_product(rows_of(pair.q, i), derivative(pair.p) + j, n_);
    }
    const PackArray share = PackArray{w_.pairs.x} + (index * n_ + i) * n_ + j;
    for (unsigned r = 0; r < kRows; ++r)
      for (unsigned c = 0; c < kAtOnce; ++c) {
        Pack of_pair = magnitude(sum.x[r][c]) * weight;
        if (curved) of_pair = of_pair + PackArray{w_.pair_radius.x}[r * n_ + j + c];
        if (plan_.keeps_shares) share.put(r * n_ + c, of_pair);
        P.x[r][c] = P.x[r][c] + of_pair;
      }
  }

  /// Reads −B_pq or −½B_pp, at their middles, and stores what their radii add.
  template <unsigned kRows, unsigned kAtOnce>
  REGULUS_LANE_INLINE void read_second(const SecondOrderPlan::Pair& pair, const Pack& weight,
                                       unsigned i, unsigned j,
                                       Block<kRows, kAtOnce>& sum) noexcept {
    const double share = pair.p == pair.q ? 0.5 : 1.0;
    const Pack part = weight * Pack::of(share), sign = Pack::of(-share);
    const PackArray radius = PackArray{w_.pair_radius.x} + j;
    if (pair.second.size() == n_ * n_) {
      const SecondOrderPlan::Entry* entry = plan_.entries + pair.second.begin + i * n_ + j;
      for (unsigned r = 0; r < kRows; ++r)
        for (unsigned c = 0; c < kAtOnce; ++c)
          sum.x[r][c] = sign * second(entry[r * n_ + c], part, radius + (r * n_ + c));
      return;
    }
    const PackArray middle = PackArray{w_.pair_sum.x} + j;
    for (const PackArray& x : {middle, radius})
      for (unsigned r = 0; r < kRows; ++r) clear(x + r * n_, kAtOnce);
    const unsigned* starts = plan_.starts + pair.starts + i;
    for (unsigned e = starts[0]; e < starts[kRows]; ++e) {
      const SecondOrderPlan::Entry& entry = plan_.entries[e];
      const unsigned at = entry.place - (i * n_ + j);
      if (entry.column - j < kAtOnce) middle.put(at, sign * second(entry, part, radius + at));
    }
    sum.read(middle, n_);
  }

  /// Returns the middle of a derivative; stores what its radius adds.
  [[nodiscard]] REGULUS_LANE_INLINE Pack second(const SecondOrderPlan::Entry& entry,
                                                const Pack& part, PackArray radius) noexcept {
    const Middle b = middle_of(in_.second, entry.at);
    const Pack of_radius = product_ru(raised(b.distance, kOneTerm), part);
    radius.put(0, of_radius);
    PackArray{w_.magnitude_of_B.x}.add(entry.place, magnitude(b.middle) * part + of_radius);
    return b.middle;
  }

 protected:
  // Copies: otherwise the compiler must assume that a store through a pointer may change one of
  // these. For the same reason everything is inlined into bound().
  const SecondOrderPlan plan_;
  const SecondOrderInput in_;
  const SecondOrderWork w_;
  const unsigned n_;
};

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::second_order
