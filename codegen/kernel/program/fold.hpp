// SPDX-License-Identifier: GPL-3.0-or-later
// Exact values of operations on rational constants, if the value is again rational.
#pragma once

#include <cln/rational.h>

#include <cstdint>
#include <optional>

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// Returns value^exponent, or nullopt if the result would be too long.
[[nodiscard]] std::optional<cln::cl_RA> fold_power(const cln::cl_RA& value, std::uint32_t exponent);

/// Returns function(value) if it is defined and a known rational, e.g. sqrt(9/4), cos(0), |−3|.
[[nodiscard]] std::optional<cln::cl_RA> fold_call(Op function, const cln::cl_RA& value);

}  // namespace regulus::detail
