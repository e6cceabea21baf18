// SPDX-License-Identifier: GPL-3.0-or-later
// Reproducible random choices: one seed gives one model.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail::attack {

/// Generates numbers by SplitMix64.
class Random {
 public:
  /// `stream` makes the families of one seed independent.
  Random(std::string_view stream, std::uint64_t seed) : state_(seed) {
    for (const char c : stream) state_ = mix(state_ ^ static_cast<unsigned char>(c)) + kStep;
  }

  std::uint64_t bits() { return mix(state_ += kStep); }

  /// Returns a number from 0 to count − 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
  /// Returns a number from lo to hi, both included.
  long between(long lo, long hi) {
    return lo + static_cast<long>(below(static_cast<std::size_t>(hi - lo + 1)));
  }
  bool one_in(std::size_t count) { return below(count) == 0; }

  template <class T>
  T pick(const std::vector<T>& from) {
    return from[below(from.size())];
  }
  std::string pick(std::initializer_list<const char*> from) {
    return from.begin()[below(from.size())];
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace regulus::detail::attack
