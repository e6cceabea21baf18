// SPDX-License-Identifier: Apache-2.0
// Everything that backend_*.cpp compile, each for one instruction set.
#pragma once

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/h_matrix_lanes.hpp"
#include "runtime/regularity/inverse_lanes.hpp"
#include "runtime/regularity/minors_lanes.hpp"
#include "runtime/regularity/orthants_lanes.hpp"
#include "runtime/regularity/second_order_impact_lanes.hpp"
#include "runtime/regularity/second_order_lanes.hpp"

namespace regulus::detail::regularity {
inline namespace REGULUS_LANES_ISA {

inline constexpr RegularityBackend kBackend{minors::expand,
                                            minors::permanent,
                                            minors::vertices_share_sign,
                                            h_matrix::distance,
                                            h_matrix::lower_to_mean_value,
                                            h_matrix::solve_for_ones,
                                            h_matrix::multiply,
                                            h_matrix::perron,
                                            inverse::invert,
                                            inverse::round_rows_to_grid,
                                            inverse::within,
                                            inverse::take_middles,
                                            second_order::bound,
                                            second_order::impact,
                                            orthants::possible,
                                            orthants::remaining};

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::regularity
