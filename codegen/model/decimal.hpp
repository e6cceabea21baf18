// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as the exact rationals they denote.
#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace regulus::inline model {

// Limits of a number. No robot needs more, and ten characters could ask for gigabytes without them.
constexpr std::size_t kMaxDigits = 1000;
constexpr int kMaxExponent = 1000;

/// What is expected of a number beyond these limits, for messages.
constexpr const char* kNumberLimits = "at most 1000 digits and an exponent within ±1000";

/// The rational that a decimal literal denotes: "12", "0.1", ".5", "3.", "1.5e-3".
///
/// Requires  the text matches (digits [. digits?] | . digits) ([eE] [+-]? digits)?, in ASCII.
/// Ensures   exact, never a float; nullopt for more than kMaxDigits or an exponent beyond
///           ±kMaxExponent.
[[nodiscard]] std::optional<GiNaC::numeric> exact_decimal(std::string_view literal);

/// The rational that a number of TOML denotes: "+1_000.5e-3", "-0.0", "0xff_ff", "0o17", "0b101".
///
/// Ensures   exact; nullopt for what is no finite number of TOML 1.0, and beyond the limits of
///           exact_decimal.
[[nodiscard]] std::optional<GiNaC::numeric> exact_toml_number(std::string_view literal);

/// The binary number that the double is: of 0.1 it is 3602879701896397/2^55, not 1/10.
///
/// Requires  value finite.
[[nodiscard]] GiNaC::numeric exact_value(double value);

/// Whether `nearest` is a double that `exact` rounds to; of a tie both are.
///
/// Requires  exact rational, nearest finite.
[[nodiscard]] bool rounds_to(const GiNaC::numeric& exact, double nearest);

/// The shortest decimal that reads back as `value`, as an exact rational: 0.1 gives 1/10. For
/// values that a program chooses and prints; what was written has a text to be read instead.
///
/// Requires  value finite.
[[nodiscard]] GiNaC::numeric shortest_decimal(double value);

/// The integer itself; GiNaC's constructors take no 64-bit integer on every platform.
[[nodiscard]] GiNaC::numeric exact_integer(std::int64_t value);

}  // namespace regulus::inline model
