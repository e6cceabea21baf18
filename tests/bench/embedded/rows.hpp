// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// A check inside a control loop: runtime/embedded, the kernel in memory.
[[nodiscard]] Section embedded_rows();

}  // namespace regulus::bench
