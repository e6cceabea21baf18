// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "regulus/codegen/jit/reader/syntax.hpp"
#include "regulus/codegen/jit/reader/token.hpp"

namespace regulus::codegen::reader {

/// Reads the text of a kernel as emit() writes it. A C++ front end takes most of the time of a
/// compilation to find out that nothing of C++ is in it but arithmetic.
///
/// Requires  the text outlives the result.
/// Ensures   what is accepted is C++ and means what is written here: operators have C++'s
///           precedence and group to the left.
/// Throws    OutsideSubset, for anything else: another C++ compiler decides what it means.
[[nodiscard]] KernelText parse_kernel(std::string_view text);

}  // namespace regulus::codegen::reader
