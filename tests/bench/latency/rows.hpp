// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Times the command as a process: with an empty cache, with a filled cache, and doing nothing.
[[nodiscard]] Section process_rows();

/// Times compiling a kernel's text in process against a spawned compiler.
[[nodiscard]] Section compile_rows();

}  // namespace regulus::detail::bench
