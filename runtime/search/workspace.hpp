// SPDX-License-Identifier: Apache-2.0
// The part of a variety that meets its constraints, whatever the matrix is there.
#pragma once

#include <atomic>
#include <cstdint>

#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// The most boxes that are looked at.
constexpr std::uint64_t kMostWorkspaceBoxes = 1 << 16;

/// Splits the motion parameters that are not single values until a box is inside, outside, narrower
/// than `resolution`, a part of each range, or until there are too many boxes.
///
/// Requires  the problem has constraints.
/// Ensures   the volumes enclose those of the true ranges, as in `volumes`.
[[nodiscard]] Workspace measure_workspace(const Problem& problem, const Volumes& volumes,
                                          double resolution, const std::atomic<bool>& interrupt);

}  // namespace regulus::detail
