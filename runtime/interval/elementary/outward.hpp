// SPDX-License-Identifier: Apache-2.0
// Computes bounds from a nearly nearest value, in any number of lanes.
#pragma once

#include "runtime/interval/elementary/lanes.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

template <class T>
struct Bounds {
  T lo;
  T hi;
};

/// `undefined` marks the lanes in which some point is outside the domain; their bounds are
/// meaningless.
template <class T>
struct Partial {
  Bounds<T> value;
  Mask<T> undefined;
};

/// Returns 1 for a clear sign bit, else −1: one unit in the last place, away from −∞.
template <class T>
inline Bits<T> upward_unit(T x) noexcept {
  return (Bits<T>)(((Mask<T>)to_bits(x) >> 63) | 1);
}

// The neighbours of a finite x that is not 0.
template <class T>
inline T step_up_nonzero(T x) noexcept {
  return from_bits(to_bits(x) + upward_unit(x));
}
template <class T>
inline T step_down_nonzero(T x) noexcept {
  return from_bits(to_bits(x) - upward_unit(x));
}

/// The next double in the direction of +∞; −0 counts as 0. Requires x finite.
template <class T>
inline T step_up(T x) noexcept {
  return step_up_nonzero(x + splat<T>(0));
}
template <class T>
inline T step_down(T x) noexcept {
  return -step_up(-x);
}

template <int kSteps, class T>
inline T steps_up(T x) noexcept {
  for (int i = 0; i < kSteps; ++i) x = step_up(x);
  return x;
}
template <int kSteps, class T>
inline T steps_down(T x) noexcept {
  return -steps_up<kSteps>(-x);
}

// For functions whose computed value is 0 exactly where the function is 0.
template <class T>
inline T step_up_unless_zero(T x) noexcept {
  return select(equal(x, splat<T>(0)), x, step_up_nonzero(x));
}
template <class T>
inline T step_down_unless_zero(T x) noexcept {
  return select(equal(x, splat<T>(0)), x, step_down_nonzero(x));
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
