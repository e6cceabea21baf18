// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// The command as a process: with an empty cache, with a filled one, and doing nothing.
[[nodiscard]] Section process_rows();

/// Compiling a kernel's text in process, and by a compiler that is spawned.
[[nodiscard]] Section compile_rows();

}  // namespace regulus::bench
