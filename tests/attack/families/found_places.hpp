// SPDX-License-Identifier: GPL-3.0-or-later
// The families of mechanisms share these numbers, and places that Newton's method has found.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/attack/families/builder.hpp"

namespace regulus::detail::attack {

inline Rational eighths(Builder& b) { return Rational(b.random.between(-40, 40), 8); }

inline double number_of(const Rational& value) {
  return arf_get_d(arb_midref(Value(value).ball()), ARF_RND_NEAR);
}

inline double uniform(Builder& b, double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(b.random.bits() >> 11) * 0x1p-53;
}

inline std::string numbers_text(const std::vector<Rational>& numbers) {
  std::string text;
  for (const Rational& number : numbers)
    text += (text.empty() ? "" : ", ") + quoted(number.fraction());
  return "[" + text + "]";
}

inline void state_mechanism(Builder& b, const std::string& argument) {
  SolveTruth& truth = *b.attack.solve;
  b.attack.truth = truth.is_degenerate ? Truth::kSingular : Truth::kRegular;
  b.attack.argument = argument;
}

inline bool is_among(const std::vector<std::map<std::string, double>>& all,
                     const std::map<std::string, double>& one,
                     const std::vector<std::string>& angles) {
  return std::ranges::any_of(all, [&](const auto& other) {
    return std::ranges::all_of(one, [&](const auto& entry) {
      double gap = entry.second - other.at(entry.first);
      if (std::ranges::find(angles, entry.first) != angles.end())
        gap = std::remainder(gap, 2 * std::numbers::pi);
      return std::fabs(gap) < 1e-5;
    });
  });
}

}  // namespace regulus::detail::attack
