// SPDX-License-Identifier: GPL-3.0-or-later
// Decimals as the exact rationals they denote.
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <string_view>

namespace regulus::codegen {

/// The rational that a decimal literal denotes: "12", "0.1", ".5", "3.", "1.5e-3".
///
/// Requires  the text matches (digits [. digits?] | . digits) ([eE] [+-]? digits)?, in ASCII.
/// Ensures   exact, never a float; nullopt for more than 1000 digits or an exponent beyond ±1000,
///           which no robot needs and which would let ten characters ask for gigabytes.
[[nodiscard]] std::optional<GiNaC::numeric> exact_decimal(std::string_view literal);

/// The shortest decimal that reads back as `value`, as an exact rational: 0.1 gives 1/10.
///
/// Requires  value finite.
[[nodiscard]] GiNaC::numeric shortest_decimal(double value);

/// The integer itself; GiNaC's constructors take no 64-bit integer on every platform.
[[nodiscard]] GiNaC::numeric exact_integer(std::int64_t value);

}  // namespace regulus::codegen
