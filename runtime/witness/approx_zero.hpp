// SPDX-License-Identifier: Apache-2.0
// Looks for the change of sign of a function of one variable, by eight values at a time. A
// heuristic: nothing is proved.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "runtime/interval/lanes.hpp"

namespace regulus::detail {

/// A function on [0, 1] that is positive at 0 and negative at 1, and the part of [0, 1] in which it is
/// known to change its sign.
class ApproxZero {
 public:
  ApproxZero(double at_zero, double at_one) noexcept
      : ends_{{{0.0, at_zero}, {1.0, at_one}}}, beyond_(ends_) {}

  [[nodiscard]] double from() const noexcept { return ends_[0].at; }
  [[nodiscard]] double to() const noexcept { return ends_[1].at; }
  [[nodiscard]] double width() const noexcept { return to() - from(); }

  /// Returns how often [0, 1] may be halved, at most `most` times, until the change of sign may be in
  /// either half.
  [[nodiscard]] std::size_t approx_halvings(std::size_t most) const noexcept {
    double low = 0.0, high = 1.0;
    for (std::size_t k = 0; k < most; ++k) {
      const double middle = 0.5 * (low + high);
      if (from() < middle && middle < to()) return k;
      (from() >= middle ? low : high) = middle;
    }
    return most;
  }

  /// Chooses where to look next, in rising order, strictly between from() and to(): at equal
  /// distances first, then at falling distances from where interpolation expects the zero.
  ///
  /// Shape     part: kLanes entries; returns how many are used.
  std::size_t choose_parts(double* part) const noexcept {
    constexpr double kDistances[] = {-0x1p-2, -0x1p-6, -0x1p-11, -0x1p-17,
                                     0x1p-17, 0x1p-11, 0x1p-6,   0x1p-2};
    const bool first = beyond_[0].at == from() && beyond_[1].at == to();
    const double expected = interpolated();
    std::size_t count = 0;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double at = first ? from() + width() * static_cast<double>(k + 1) / (kLanes + 1)
                              : expected + width() * kDistances[k];
      if (from() < at && at < to() && (count == 0 || part[count - 1] < at)) part[count++] = at;
    }
    return count;
  }

  /// Takes the function's value at a place that choose_parts chose, in the same order.
  void learn(double at, double value) noexcept {
    if (at > to() && at < beyond_[1].at) beyond_[1] = {at, value};
    if (!(from() < at && at < to())) return;
    const std::size_t end = value > 0.0 ? 0 : 1;
    beyond_[end] = ends_[end];
    ends_[end] = {at, value};
  }

 private:
  struct Value {
    double at, of;
  };

  /// The zero of the parabola at = p(of) through three of the values, or of the chord.
  [[nodiscard]] double interpolated() const noexcept {
    const auto [a, b] = ends_;
    const double chord = (b.at - a.at) / (b.of - a.of), linear = a.at - a.of * chord;
    const bool left = beyond_[0].at < a.at && a.at - beyond_[0].at < beyond_[1].at - b.at;
    const Value& c = left || beyond_[1].at == b.at ? beyond_[0] : beyond_[1];
    const double other = (c.at - b.at) / (c.of - b.of);
    const double curved = linear + a.of * b.of * (other - chord) / (c.of - a.of);
    if (from() < curved && curved < to()) return curved;
    return from() < linear && linear < to() ? linear : 0.5 * (from() + to());
  }

  std::array<Value, 2> ends_;
  std::array<Value, 2> beyond_;  ///< the next known values outside
};

}  // namespace regulus::detail
