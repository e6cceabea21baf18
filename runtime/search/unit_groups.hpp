// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace regulus::detail {

/// Cuts a list of boxes into at most `most` groups of neighbours, so that the groups have about the
/// same volume. `depths`: the splits above each box, which has 2^-depth of the whole volume.
///
/// Returns the numbers of boxes of the groups; each is at least 1.
[[nodiscard]] std::vector<std::size_t> cut_into_groups(std::span<const std::uint32_t> depths,
                                                       std::size_t most);

}  // namespace regulus::detail
