// SPDX-License-Identifier: GPL-3.0-or-later
// Algebra with exact numbers: rationals, square roots, sines and cosines of constants.
#pragma once

#include <ginac/ginac.h>

#include <array>

namespace regulus::detail {

using Point = std::array<GiNaC::ex, 3>;
inline constexpr std::array<const char*, 3> kCoordinates = {"x", "y", "z"};

/// Returns the same number or polynomial, expanded, with square roots of primes only, and with no
/// power of a sine above the first. Equal numbers of the field of sqrt(2), sqrt(3), sqrt(5) and cos pi/10,
/// that of all multiples of pi/12 and pi/10, become equal expressions.
[[nodiscard]] GiNaC::ex reduced(const GiNaC::ex& e);

/// True if the expression is proved to be zero for all values of its symbols. False says nothing.
[[nodiscard]] bool is_certainly_zero(const GiNaC::ex& e);

/// True if the expression has no symbols and is proved to differ from zero. False says nothing.
[[nodiscard]] bool is_certainly_nonzero(const GiNaC::ex& e);

[[nodiscard]] bool has_symbols(const GiNaC::ex& e);

[[nodiscard]] GiNaC::ex dot(const Point& u, const Point& v);
[[nodiscard]] Point cross(const Point& u, const Point& v);
[[nodiscard]] Point sum(const Point& u, const Point& v);
[[nodiscard]] Point scaled(const GiNaC::ex& factor, const Point& v);
[[nodiscard]] Point reduced(const Point& v);
/// Returns R·v, and Rᵀ·v.
[[nodiscard]] Point times(const GiNaC::matrix& R, const Point& v);
[[nodiscard]] Point transposed_times(const GiNaC::matrix& R, const Point& v);

}  // namespace regulus::detail
