// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Compares the AVX-512 kernel for K·M with the limits of the processor.
[[nodiscard]] Section limit_rows();

}  // namespace regulus::detail::bench
