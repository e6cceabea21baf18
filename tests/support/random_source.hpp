// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>

#include "runtime/interval/interval.hpp"

namespace regulus::detail::test {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t below(std::uint64_t count) { return next() % count; }
  bool one_in(std::uint64_t count) { return below(count) == 0; }
  /// Returns a number in [0, 1) that is a multiple of 2^-53.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }

 private:
  std::uint64_t state_;
};

/// Returns a double as kernels may receive it. Values that often break bounds are more likely: 0,
/// small integers, tiny and huge values of either sign.
inline double corner_double(RandomSource& random, int largest_exponent) {
  const double sign = random.one_in(2) ? -1.0 : 1.0;
  switch (random.below(9)) {
    case 0:
      return sign * 0.0;
    case 1:
      return sign * static_cast<double>(random.below(4));
    case 2:
      return sign * std::ldexp(1.0 + random.unit(), -static_cast<int>(random.below(1075)));
    case 3:
      return sign * std::ldexp(1.0, largest_exponent);
    case 4:
      return sign * std::ldexp(0.5 + random.unit() / 2,
                               static_cast<int>(
                                   random.below(static_cast<std::uint64_t>(largest_exponent) + 1)));
    default:
      return sign * random.between(0, 4);
  }
}

/// Returns a thin interval, one of a single step, a narrow or a wide one.
inline Interval corner_interval(RandomSource& random, int largest_exponent) {
  const double a = corner_double(random, largest_exponent);
  switch (random.below(4)) {
    case 0:
      return Interval{a};
    case 1:
      return Interval{a,
                      std::fmin(std::nextafter(a, kInfinity), std::ldexp(1.0, largest_exponent))};
    case 2: {
      const double b = a * (1 + 1e-3 * random.unit());
      return Interval{std::fmin(a, b),
                      std::fmin(std::fmax(a, b), std::ldexp(1.0, largest_exponent))};
    }
    default: {
      const double b = corner_double(random, largest_exponent);
      return Interval{std::fmin(a, b), std::fmax(a, b)};
    }
  }
}

/// Returns a point of x, often one of its ends.
inline double point_of(RandomSource& random, const Interval& x) {
  switch (random.below(4)) {
    case 0:
      return x.lo;
    case 1:
      return x.hi;
    case 2:
      return mid(x);
    default:
      return std::fmin(
          std::fmax(x.lo / 2 + x.hi / 2 + (x.hi / 2 - x.lo / 2) * (2 * random.unit() - 1), x.lo),
          x.hi);
  }
}

}  // namespace regulus::detail::test
