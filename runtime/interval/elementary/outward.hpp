// SPDX-License-Identifier: Apache-2.0
// From a nearly nearest value to its bounds, in any number of lanes.
#pragma once

#include "regulus/interval/elementary/lanes.hpp"

namespace regulus::elementary {
inline namespace REGULUS_LANES_ISA {

template <class T>
struct Bounds {
  T lo;
  T hi;
};

/// `undefined` marks the lanes where some point is outside the domain; their bounds are
/// meaningless.
template <class T>
struct Partial {
  Bounds<T> value;
  Mask<T> undefined;
};

/// The next double in the direction of +∞; −0 counts as 0. Requires x finite.
template <class T>
inline T step_up(T x) noexcept {
  const T positive_zero = x + splat<T>(0);
  const Mask<T> one_outward = less(positive_zero, splat<T>(0)) | 1;
  return from_bits(to_bits(positive_zero) + (Bits<T>)one_outward);
}
template <class T>
inline T step_down(T x) noexcept {
  return -step_up(-x);
}

// For functions whose computed value is 0 exactly where their value is 0.
template <class T>
inline T step_up_unless_zero(T x) noexcept {
  return select(equal(x, splat<T>(0)), x, step_up(x));
}
template <class T>
inline T step_down_unless_zero(T x) noexcept {
  return select(equal(x, splat<T>(0)), x, step_down(x));
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::elementary
