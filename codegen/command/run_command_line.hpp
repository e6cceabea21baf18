// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "codegen/command/command_line.hpp"

namespace regulus::inline command {

/// Runs the command, any except `shell`, and returns its exit code. `typed`: the words as typed. A
/// model may be the name of an installed one; the file that is read is then reported.
[[nodiscard]] int run_command_line(CommandLine line, const std::string& typed);

/// Returns the result of `run`. If `run` throws, prints the message on standard error, after
/// `where`, and returns the exit code of the error.
[[nodiscard]] int report_errors(const std::function<int()>& run,
                                const std::string& where = "regulus: ");

}  // namespace regulus::command
