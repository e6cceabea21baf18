// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "runtime/interval/interval.hpp"

namespace regulus::inline cpp {

/// A C++ literal that reads back as x, whatever the rounding of the compiler: an integer of few
/// digits in decimals, anything else as a hexadecimal float, infinity as the builtin.
///
/// Requires  x is not NaN.
[[nodiscard]] std::string literal(double x);

/// "constant(lo, hi)".
[[nodiscard]] std::string constant_literal(const Interval& x);

}  // namespace regulus::inline cpp
