// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Times K·M of robot 1 by our kernels, compiled in process and ahead of time, and by all rivals.
[[nodiscard]] Section kernel_rows();

}  // namespace regulus::detail::bench
