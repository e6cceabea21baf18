// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "regulus/codegen/driver/options.hpp"

namespace regulus::codegen {

/// Runs what was asked and returns its exit code. `typed`: the words as typed.
[[nodiscard]] int run_command_line(const CommandLine& line, const std::string& typed);

/// What `run` returns; where it throws, the message on standard error and the exit code that goes
/// with it. `where` stands before the message.
[[nodiscard]] int report_errors(const std::function<int()>& run,
                                const std::string& where = "regulus: ");

}  // namespace regulus::codegen
