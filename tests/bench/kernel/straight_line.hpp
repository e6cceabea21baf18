// SPDX-License-Identifier: GPL-3.0-or-later
// A program as C++ for anyone's arithmetic: what other interval libraries are timed on.
#pragma once

#include <string>

#include "codegen/program/program.hpp"

namespace regulus::bench {

/// The text of a function template `name(A& a, const A::Number* v, const double* k, A::Number*
/// out)`: every operation of the program once, in its order. Exact doubles, entries of K among
/// them, are passed as `double`, so that a library can use what it has for mixed operands.
///
/// Throws    std::invalid_argument for an operation that an arithmetic need not have:
///           straight_arithmetic.hpp has what there is.
[[nodiscard]] std::string straight_line_text(const Program& program, const std::string& name);

}  // namespace regulus::bench
