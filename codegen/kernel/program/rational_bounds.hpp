// SPDX-License-Identifier: GPL-3.0-or-later
// Converts exact rationals to doubles and back, exactly or in a stated direction.
#pragma once

#include <cln/rational.h>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns the largest double ≤ value; −∞ if value < −DBL_MAX. Never −0. Subnormals included.
[[nodiscard]] double round_down(const cln::cl_RA& value);

/// Returns the smallest double ≥ value; +∞ if value > DBL_MAX. Never −0. Subnormals included.
[[nodiscard]] double round_up(const cln::cl_RA& value);

/// Returns the narrowest interval with double bounds that contains value: thin iff value is a
/// double.
[[nodiscard]] Interval enclose(const cln::cl_RA& value);

/// Returns the exact value of x.
///
/// Requires  x finite.
[[nodiscard]] cln::cl_RA exact_rational(double x);

/// Returns an e with |value| ≤ 2^e, at most one too large.
[[nodiscard]] long exponent_bound(const cln::cl_RA& value);

}  // namespace regulus::detail
