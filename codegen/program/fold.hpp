// SPDX-License-Identifier: GPL-3.0-or-later
// Exact values of operations on rational constants, where the value is a rational again.
#pragma once

#include <cln/rational.h>

#include <cstdint>
#include <optional>

#include "codegen/program/program.hpp"

namespace regulus::inline program {

/// value^exponent, or nullopt when the result would be too long to be worth writing down.
[[nodiscard]] std::optional<cln::cl_RA> fold_power(const cln::cl_RA& value, std::uint32_t exponent);

/// function(value) when that is defined and a known rational, e.g. sqrt(9/4), cos(0), |−3|.
[[nodiscard]] std::optional<cln::cl_RA> fold_call(Op function, const cln::cl_RA& value);

}  // namespace regulus::inline program
