// SPDX-License-Identifier: Apache-2.0
// Eight boxes side by side; each has one lane.
//
// Arrays of exact doubles: entry e of a lane is x[e * kLanes + lane] ("point layout"). Arrays of
// intervals: bound s (0 lower, 1 upper) of entry e is x[(2 * e + s) * kLanes + lane] ("interval
// layout", that of runtime/kernel/abi.hpp).
#pragma once

#include <cstddef>

/// For functions that are shared by files compiled for different instruction sets: the linker must
/// not replace the code of one by that of another.
#define REGULUS_LANE_INLINE inline __attribute__((always_inline))

namespace regulus {

inline constexpr std::size_t kLanes = 8;

/// Bit l belongs to lane l.
using LaneMask = unsigned;
inline constexpr LaneMask kAllLanes = (1U << kLanes) - 1;

[[nodiscard]] REGULUS_LANE_INLINE constexpr std::size_t point_at(std::size_t entry,
                                                                 std::size_t lane) noexcept {
  return entry * kLanes + lane;
}
[[nodiscard]] REGULUS_LANE_INLINE constexpr std::size_t lower_at(std::size_t entry,
                                                                 std::size_t lane) noexcept {
  return 2 * entry * kLanes + lane;
}
[[nodiscard]] REGULUS_LANE_INLINE constexpr std::size_t upper_at(std::size_t entry,
                                                                 std::size_t lane) noexcept {
  return (2 * entry + 1) * kLanes + lane;
}

[[nodiscard]] REGULUS_LANE_INLINE constexpr bool has_lane(LaneMask lanes,
                                                          std::size_t lane) noexcept {
  return (lanes >> lane & 1U) != 0;
}

/// Calls `visit(lane)` for each lane of the mask, lowest first.
template <typename Visit>
REGULUS_LANE_INLINE constexpr void for_each_lane(LaneMask lanes, Visit&& visit) {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (has_lane(lanes, lane)) visit(lane);
}

}  // namespace regulus
