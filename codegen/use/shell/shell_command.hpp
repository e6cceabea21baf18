// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// `regulus shell`: runs each line, prints its results and returns the exit code.
[[nodiscard]] int run_shell(const ShellCommand& command);

}  // namespace regulus::detail
