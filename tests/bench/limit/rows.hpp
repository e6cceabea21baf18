// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// How near the AVX-512 kernel for K·M comes to what the processor can do.
[[nodiscard]] Section limit_rows();

}  // namespace regulus::bench
