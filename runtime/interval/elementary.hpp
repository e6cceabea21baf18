// SPDX-License-Identifier: Apache-2.0
// Elementary functions on intervals. No bound uses a library function: the evaluators and the
// arguments for their error bounds are in runtime/interval/elementary/.
//
// Requires  MXCSR at nearest (runtime/interval/rounding.hpp).
// Ensures   f(t) ∈ result for every t ∈ x, and no bound lies further out than stated, in units in
//           the last place of the exact bound. sin 0, cos 0, tan 0, asin 0, acos 1, atan 0,
//           atan2(0, 1), exp 0 and log 1 are exact.
//
// The forms with `undefined` behave as in runtime/interval/arithmetic.hpp.
#pragma once

#include "runtime/interval/type.hpp"

namespace regulus {

/// Beyond this magnitude the argument of sin, cos and tan is not reduced.
inline constexpr double kTrigonometricLimit = 0x1p20;

/// 2 ulp; [−1, 1] if a bound of x exceeds kTrigonometricLimit.
[[nodiscard]] Interval sin(Interval x) noexcept;
[[nodiscard]] Interval cos(Interval x) noexcept;

struct SinCos {
  Interval sin;
  Interval cos;
};
/// Computes both for little more than the cost of one; bit for bit sin(x) and cos(x).
[[nodiscard]] SinCos sincos(Interval x) noexcept;

/// 4 ulp. Undefined where cos x = 0, and if a bound exceeds kTrigonometricLimit.
[[nodiscard]] Interval tan(Interval x, bool& undefined) noexcept;
[[nodiscard]] Interval tan(Interval x) noexcept;

/// 2 ulp. Undefined where |x| > 1.
[[nodiscard]] Interval asin(Interval x, bool& undefined) noexcept;
[[nodiscard]] Interval asin(Interval x) noexcept;
[[nodiscard]] Interval acos(Interval x, bool& undefined) noexcept;
[[nodiscard]] Interval acos(Interval x) noexcept;

/// 2 ulp.
[[nodiscard]] Interval atan(Interval x) noexcept;

/// Returns the angle of the points (x, y), in (−π, π). 4 ulp. Undefined where y = 0 and x ≤ 0: on
/// the cut the angle jumps, and at the origin there is none.
[[nodiscard]] Interval atan2(Interval y, Interval x, bool& undefined) noexcept;
[[nodiscard]] Interval atan2(Interval y, Interval x) noexcept;

/// 2 ulp; 3 subnormal ulp below 2^-1022. A bound that overflows is ∞ above and kMaxDouble below.
[[nodiscard]] Interval exp(Interval x) noexcept;

/// 2 ulp. Undefined where x ≤ 0.
[[nodiscard]] Interval log(Interval x, bool& undefined) noexcept;
[[nodiscard]] Interval log(Interval x) noexcept;

}  // namespace regulus
