// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Instructions, counted by callgrind: these figures do not vary from run to run.
[[nodiscard]] Section count_rows();

}  // namespace regulus::detail::bench
