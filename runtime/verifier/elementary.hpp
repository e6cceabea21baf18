// SPDX-License-Identifier: Apache-2.0
// Encloses the elementary functions over intervals of doubles, by Arb's values at their ends.
#pragma once

#include <arb.h>

#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/interval.hpp"

namespace regulus::verifier {

using ArbFunction = void (*)(arb_t, const arb_t, slong);

/// Returns Arb's function for a function of one argument other than kAbs.
[[nodiscard]] ArbFunction function_in_arb(Op function);

/// Encloses f over x for the functions of one argument, kSqrt … kAbs.
///
/// Requires  x bounded.
/// Ensures   contains f(t) for every t in x; not bounded unless f is defined at every t in x.
[[nodiscard]] Interval apply(Op function, Interval x);

/// Does the same for atan2(y, x), which is undefined where y = 0, x ≤ 0.
[[nodiscard]] Interval apply_atan2(Interval y, Interval x);

[[nodiscard]] Interval enclose_pi();
[[nodiscard]] Interval enclose(const Rational& value);

}  // namespace regulus::verifier
