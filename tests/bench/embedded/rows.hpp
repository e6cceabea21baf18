// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Times a check inside a control loop: runtime/embedded, with the kernel in memory.
[[nodiscard]] Section embedded_rows();

}  // namespace regulus::detail::bench
