// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/kernel/program/module.hpp"
#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// Returns a program as text, one node per line: "%3 = multiply %1 %2". For people and for hashes:
/// programs with the same text compute the same results.
[[nodiscard]] std::string to_text(const Program& program);

/// Returns a module as text: shapes, then each function's name and program. Titles, comments and
/// the names of model and motion are left out, because they do not change the results.
[[nodiscard]] std::string to_text(const Module& module);

/// Returns the name of a module's kernel: the SHA-256 of its text, as 64 hexadecimal digits.
[[nodiscard]] std::string identity(const Module& module);

}  // namespace regulus::detail
