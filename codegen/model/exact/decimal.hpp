// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as the exact rationals they denote.
#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace regulus::detail {

// Limits of a number. No robot needs more. Without them, ten characters could request gigabytes.
constexpr std::size_t kMaxDigits = 1000;
constexpr int kMaxExponent = 1000;

/// The text of these limits, for messages.
constexpr const char* kNumberLimits = "at most 1000 digits and an exponent within ±1000";

/// Returns the rational that a decimal literal denotes: "12", "0.1", ".5", "3.", "1.5e-3".
///
/// Requires  the text matches (digits [. digits?] | . digits) ([eE] [+-]? digits)?, in ASCII.
/// Ensures   exact, never a float; nullopt for more than kMaxDigits or an exponent beyond
///           ±kMaxExponent.
[[nodiscard]] std::optional<GiNaC::numeric> exact_decimal(std::string_view literal);

/// Returns the same for a decimal with an optional sign; nullopt for any other text.
[[nodiscard]] std::optional<GiNaC::numeric> signed_decimal(std::string_view text);

/// Returns the rational that a number of TOML denotes: "+1_000.5e-3", "-0.0", "0xff_ff", "0o17",
/// "0b101".
///
/// Ensures   exact; nullopt for a text that is not a finite number of TOML 1.0, and beyond the
///           limits of exact_decimal.
[[nodiscard]] std::optional<GiNaC::numeric> exact_toml_number(std::string_view literal);

/// Returns the exact binary value of the double: for 0.1 it is 3602879701896397/2^55, not 1/10.
///
/// Requires  value finite.
[[nodiscard]] GiNaC::numeric exact_value(double value);

/// True if `nearest` is a double that `exact` rounds to; for a tie, both neighbours are.
///
/// Requires  exact rational, nearest finite.
[[nodiscard]] bool rounds_to(const GiNaC::numeric& exact, double nearest);

/// Returns the shortest decimal that reads back as `value`, as an exact rational: 0.1 gives 1/10.
/// Only for values that the program chooses and prints; a number from the user is read from its
/// text.
///
/// Requires  value finite.
[[nodiscard]] GiNaC::numeric shortest_decimal(double value);

/// Returns the integer itself. On some platforms GiNaC has no constructor for 64-bit integers.
[[nodiscard]] GiNaC::numeric exact_integer(std::int64_t value);

}  // namespace regulus::detail
