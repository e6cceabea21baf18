// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns a C++ literal that reads back as x, whatever the rounding of the compiler: a short
/// integer in decimals, infinity as the builtin, any other number as a hexadecimal float.
///
/// Requires  x is not NaN.
[[nodiscard]] std::string literal(double x);

/// Returns "constant(lo, hi)".
[[nodiscard]] std::string constant_literal(const Interval& x);

}  // namespace regulus::detail
