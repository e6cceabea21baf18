// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "codegen/command/command_line.hpp"

namespace regulus::inline command {

/// Runs the command that was asked for, any but `shell`, and returns its exit code. `typed`: the
/// words as typed.
[[nodiscard]] int run_command_line(const CommandLine& line, const std::string& typed);

/// What `run` returns; where it throws, the message on standard error and the exit code that goes
/// with it. `where` stands before the message.
[[nodiscard]] int report_errors(const std::function<int()>& run,
                                const std::string& where = "regulus: ");

}  // namespace regulus::inline command
