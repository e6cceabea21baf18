// SPDX-License-Identifier: Apache-2.0
// Computes what each variable adds to the bounds of second_order_lanes.hpp, after these.
#pragma once

#include "runtime/regularity/pack_lanes.hpp"
#include "runtime/regularity/second_order_lanes.hpp"
#include "runtime/regularity/second_order_plan.hpp"

namespace regulus::detail::second_order {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

/// Returns yᵀMv of a `rows`×`columns` matrix.
inline Pack form(PackArray y, PackArray M, PackArray v, unsigned rows, unsigned columns) noexcept {
  Pack sum = Pack::of(0.0);
  for (unsigned i = 0; i < rows; ++i) {
    Pack row = Pack::of(0.0);
    for (unsigned j = 0; j < columns; ++j) row.add_fused(M[i * columns + j], v[j]);
    sum.add_fused(y[i], row);
  }
  return sum;
}

/// P consists of the first derivatives where K does not move.
inline void add_first_order(const SecondOrderPlan& plan, const SecondOrderInput& input, PackArray y,
                            PackArray v, PackArray result) noexcept {
  for (unsigned p = plan.moving; p < plan.wides; ++p) {
    const SecondOrderPlan::Wide& wide = plan.wide[p];
    const Pack radius = Pack::load(input.radius.data() + wide.variable * kLanes);
    Pack sum = Pack::of(0.0);
    for (unsigned k = wide.first.begin; k < wide.first.end; ++k) {
      const SecondOrderPlan::Entry& entry = plan.entries[k];
      sum.add_fused(y[entry.row] * largest_of(input.first, entry.at), v[entry.column]);
    }
    (result + wide.variable).add_fused(0, sum, radius);
  }
}

/// yᵀTv is a sum of parts of single variables, after Q = weight·P + rest is expressed through P.
inline void impact(const SecondOrderPlan& plan, const SecondOrderInput& input,
                   const SecondOrderWork& work, PerronVectors vectors,
                   PointVector impacts) noexcept {
  const unsigned n = plan.columns_of_A, s = plan.slots;
  const PackArray v = packs_of(vectors.right), y = packs_of(vectors.left);
  const PackArray result = packs_of(impacts);
  const PackArray lower_v = v + n, lower_y = y + n, through_P{work.center.x};
  for (unsigned i = 0; i < n; ++i) {
    Pack sum = y[i];
    for (unsigned j = 0; j < s; ++j)
      sum.add_fused(lower_y[j],
                    PackArray{work.weight.x}[j * n + i] + PackArray{work.weight_of_g.x}[j * n + i]);
    through_P.put(i, sum);
  }
  const auto of_variable = [&](unsigned p) { return result + plan.wide[p].variable; };
  for (unsigned p = 0; p < plan.wides; ++p) {
    Pack sum = form(lower_y, PackArray{work.R_of_wide.x} + (1 + p) * s * s, lower_v, s, s);
    Pack upper = Pack::of(0.0);
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < s; ++j)
        upper.add_fused(y[i] * lower_v[j],
                        magnitude((PackArray{work.DK.x} + p * n * s)[i * s + j]));
    sum.add_fused(upper, Pack::load(input.radius.data() + plan.wide[p].variable * kLanes));
    of_variable(p).put(0, sum);
  }
  // Half of a pair counts for each of its variables.
  const Pack half = Pack::of(0.5);
  for (unsigned i = 0; i < n; ++i)
    for (unsigned k = 0; k < plan.pairs; ++k) {
      const Pack share =
          half * form(through_P + i, PackArray{work.pairs.x} + (k * n + i) * n, v, 1, n);
      of_variable(plan.pair[k].p).add(0, share);
      of_variable(plan.pair[k].q).add(0, share);
    }
  add_first_order(plan, input, through_P, v, result);
  if (!plan.weighs_row_variables) return;
  for (unsigned g = 0; g < plan.groups; ++g)
    for (unsigned k = plan.group[g].members.begin; k < plan.group[g].members.end; ++k) {
      const SecondOrderPlan::RowVariable& u = plan.row_variables[k];
      result.put(u.variable,
                 form(lower_y + u.slot, PackArray{work.R_of_row.x} + k * s, lower_v, 1, s));
    }
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::second_order
