// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace regulus::detail {

/// Returns the columns of a terminal; of one that does not say, and of another file, 80.
[[nodiscard]] std::size_t columns_of_terminal(int file) noexcept;

}  // namespace regulus::detail
