// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string>

#include "codegen/support/exit_code.hpp"

namespace regulus::detail {

/// With --json, an error is an object on standard output besides the message on standard error.
enum class ErrorFormat { kText, kJson };

/// Returns the format that the words of a command line ask for.
[[nodiscard]] ErrorFormat error_format(int argc, const char* const* argv);

/// Returns {"error": {"kind", "message", "exit"}} as one line; an InputError adds "file", "line",
/// "problem", "remedy" and "symbol". Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string json_error(const std::exception& error, ExitCode code);

}  // namespace regulus::detail
