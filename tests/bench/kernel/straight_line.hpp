// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a program as C++ for any arithmetic; the benchmarks time other libraries on this text.
#pragma once

#include <string>

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail::bench {

/// Returns the text of a function template `name(A& a, const A::Number* v, const double* k,
/// A::Number* out)`. It performs every operation of the program once, in order. Exact doubles, and
/// entries of K, are passed as `double`, so that a library can use its own mixed operations.
///
/// Throws    std::invalid_argument for an operation that an arithmetic need not have:
///           operator_arithmetic.hpp has those that it must have.
[[nodiscard]] std::string straight_line_text(const Program& program, const std::string& name);

}  // namespace regulus::detail::bench
