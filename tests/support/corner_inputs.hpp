// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded doubles and intervals with many cases in which interval arithmetic may fail.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "runtime/interval/type.hpp"

namespace regulus::detail::test {

/// Returns the double `steps` after x in the order of doubles (before it if negative); x finite.
inline double step(double x, int steps) {
  for (; steps > 0; --steps) x = next_up(x);
  for (; steps < 0; ++steps) x = next_down(x);
  return x;
}

/// Draws finite doubles: about a quarter are corners or their neighbours, a quarter random bit
/// patterns, the rest random in size and value between `least` and `most`.
class CornerInputs {
 public:
  explicit CornerInputs(std::uint64_t seed, double least = -kMaxDouble, double most = kMaxDouble)
      : random_(seed), least_(least), most_(most) {}

  /// Adds corners to the general ones: edges of a domain, ends of the pieces of an evaluator.
  CornerInputs& with(std::initializer_list<double> corners) {
    corners_.insert(corners_.end(), corners);
    return *this;
  }

  /// Adds doubles near multiples of π/2 below 2^20, where argument reduction cancels most.
  CornerInputs& with_quarter_turns() {
    quarter_turns_ = true;
    return *this;
  }

  [[nodiscard]] double number() {
    for (;;) {
      const double x = candidate();
      if (least_ <= x && x <= most_) return x;
    }
  }

  /// Returns a thin, narrow or wide interval: neighbours, across zero, or any two numbers.
  [[nodiscard]] Interval interval() {
    const double a = number();
    switch (below(5)) {
      case 0:
        return a;
      case 1:
        return ordered(a, clamp(step(a, below(4))));
      case 2:
        return ordered(a, clamp(-a * uniform(0, 2)));
      case 3:
        return ordered(a, clamp(a + uniform(-2, 2)));
      default:
        return ordered(a, number());
    }
  }

  [[nodiscard]] int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  [[nodiscard]] double uniform(double lo, double hi) {
    return lo + (hi - lo) * std::ldexp(static_cast<double>(random_() >> 11), -53);
  }

 private:
  double candidate() {
    switch (below(8)) {
      case 0:
      case 1:
        return step(corner(), below(5) - 2);
      case 2:
        return any_bits();
      case 3:
        return std::ldexp(uniform(-2, 2), below(2090) - 1060);
      case 4:
        if (quarter_turns_) return near_quarter_turn();
        [[fallthrough]];
      case 5:
        return uniform(std::max(least_, -10.0), std::min(most_, 10.0));
      case 6:
        return uniform(std::max(least_, -1e3), std::min(most_, 1e3));
      default:
        return std::ldexp(uniform(-1, 1), below(80) - 60);
    }
  }

  double corner() {
    static constexpr double kGeneral[] = {
        0.0, -0.0, kMinSubnormal, 0x1p-1022, 0x1p-538, 0x1p-27, 0.5,     1.0,       1.5,
        2.0, 3.0,  0x1p52,        0x1p53,    0x1p64,   0x1p128, 0x1p512, kMaxDouble};
    constexpr int kGeneralCount = static_cast<int>(std::size(kGeneral));
    const int i = below(kGeneralCount + static_cast<int>(corners_.size()));
    const double x =
        i < kGeneralCount ? kGeneral[i] : corners_[static_cast<std::size_t>(i - kGeneralCount)];
    return below(2) ? x : -x;
  }

  double any_bits() {
    for (;;) {
      const double x = std::bit_cast<double>(static_cast<std::uint64_t>(random_()));
      if (std::isfinite(x)) return x;
    }
  }

  double near_quarter_turn() {
    const int k = below(1 << below(20)) + 1;
    const double turn = static_cast<double>(static_cast<long double>(k) * 1.57079632679489661923L);
    return step(below(2) ? turn : -turn, below(5) - 2);
  }

  [[nodiscard]] double clamp(double x) const { return std::clamp(x, least_, most_); }
  static Interval ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

  std::mt19937_64 random_;
  double least_;
  double most_;
  bool quarter_turns_ = false;
  std::vector<double> corners_;
};

}  // namespace regulus::detail::test
