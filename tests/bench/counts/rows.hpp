// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// Instructions, counted by callgrind: figures that do not wobble.
[[nodiscard]] Section count_rows();

}  // namespace regulus::bench
