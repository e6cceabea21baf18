// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "codegen/use/command/command_line.hpp"
#include "codegen/use/command/error_report.hpp"

namespace regulus::detail {

/// Runs the command, any except `shell`, and returns its exit code. `typed`: the words as typed. A
/// model may be the name of an installed one; the file that is read is then reported.
[[nodiscard]] int run_command_line(CommandLine line, const std::string& typed);

/// Returns the result of `run`. If `run` throws, prints the message on standard error, after
/// `where`, and returns the exit code of the error. With ErrorFormat::kJson standard output has the
/// error as an object, too.
[[nodiscard]] int report_errors(const std::function<int()>& run,
                                const std::string& where = "regulus: ",
                                ErrorFormat format = ErrorFormat::kText);

}  // namespace regulus::detail
