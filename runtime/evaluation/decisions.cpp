// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/decisions.hpp"

namespace regulus::detail {

MidpointDeterminants approx_midpoint_determinants(Batch& batch, LaneMask lanes,
                                                  bool scaled) noexcept {
  MidpointDeterminants midpoint_determinants;
  midpoint_determinants.lanes = lanes & batch.midpoint_defined() & batch.midpoint_inside();
  for_each_lane(midpoint_determinants.lanes, [&](std::size_t lane) {
    // If elimination breaks down on a matrix, it has no inverse; its determinant counts as 0.
    double approx = 0.0;
    if (has_lane(batch.preconditioned(), lane)) {
      approx = batch.approx_determinant(lane);
      if (scaled) approx *= batch.approx_row_scale(lane);
    }
    midpoint_determinants.approx[lane] = approx;
  });
  return midpoint_determinants;
}

}  // namespace regulus::detail
