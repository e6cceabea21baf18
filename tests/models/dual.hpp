// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers with a derivative: value + slope·ε, ε² = 0. They differentiate a function to the last
// digit, without any formula for its derivative.
#pragma once

#include <cmath>

namespace regulus::detail::test {

struct Dual {
  double value = 0;
  double slope = 0;
};

inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
inline Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
inline Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
inline Dual sqrt(Dual a) {
  const double root = std::sqrt(a.value);
  return {root, a.slope / (2 * root)};
}

}  // namespace regulus::detail::test
