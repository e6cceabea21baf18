// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/program/module.hpp"
#include "codegen/program/program.hpp"

namespace regulus::inline program {

/// A program as text, one node per line: "%3 = multiply %1 %2". For reading and for hashing:
/// programs with the same text compute the same.
[[nodiscard]] std::string to_text(const Program& program);

/// A module as text: shapes, then each function's name and program. Titles, comments and the names
/// of model and motion are left out: they do not change what is computed.
[[nodiscard]] std::string to_text(const Module& module);

/// What the kernel of a module is known by: 32 hexadecimal digits, equal for equal texts. Not a
/// defence against forgery.
///
/// Source    FNV-1a, 128 bits (Fowler, Noll, Vo; IETF draft-eastlake-fnv).
[[nodiscard]] std::string identity(const Module& module);

}  // namespace regulus::inline program
