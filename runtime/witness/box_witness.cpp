// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/box_witness.hpp"

namespace regulus::detail {

BoxWitness::BoxWitness(const Problem& problem, const Settings& settings)
    : problem_(problem), search_(problem, settings, false), whole_{{WitnessPoint{}}} {
  whole_.points[0].variables.resize(problem.kernel->variables);
}

/// A box that extends beyond the true range still has points of it; all their values are small.
bool BoxWitness::small_throughout(Batch& batch, std::size_t lane) noexcept {
  const regulus_kernel& kernel = *problem_.kernel;
  if (!(problem_.alpha.lo > 0.0) || kernel.rows != kernel.columns) return false;
  if (!has_lane(batch.certain_inside(), lane)) return false;
  const std::optional<Interval> determinant = batch.determinant(lane, true);
  if (!determinant || !(mag(*determinant) <= problem_.alpha.lo)) return false;
  WitnessPoint& point = whole_.points[0];
  for (std::size_t k = 0; k < point.variables.size(); ++k) point.variables[k] = batch.box(k, lane);
  point.determinant = *determinant;
  witness_ = &whole_;
  reason_ = Reason::kSmallDeterminant;
  return true;
}

bool BoxWitness::somewhere_in(std::span<const Interval> box) {
  if (!search_.look_inside(box)) return false;
  witness_ = &search_.witness();
  reason_ = search_.reason();
  return true;
}

}  // namespace regulus::detail
