// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Measures pages of `regulus report`: their sizes, and the time until a browser has drawn them.
[[nodiscard]] Section page_rows();

}  // namespace regulus::detail::bench
