// SPDX-License-Identifier: GPL-3.0-or-later
// The code that all families share: it chooses numbers, declares quantities, hides a determinant.
#pragma once

#include <string>
#include <vector>

#include "tests/attack/families/spelling.hpp"
#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::detail::attack {

/// Returns (x - p).
[[nodiscard]] inline std::string minus(const std::string& x, const std::string& p) {
  return "(" + x + " - " + p + ")";
}

class Builder {
 public:
  Builder(const char* family, std::uint64_t seed);

  Random random;
  Attack attack;

  /// Returns a rational: a small fraction, a decimal of up to 17 or 60 digits, a dyadic number.
  Rational number();
  /// Returns such a rational above 0.
  Rational positive();
  /// Returns c·10^-k, with k from 6 to `most`.
  Rational margin(long most = 300);
  /// Returns 0, a margin, or a negative margin.
  Rational excess(long most = 300);
  bool coin() { return random.one_in(2); }

  [[nodiscard]] std::string text(const Rational& value) { return spell_expression(value, random); }

  /// Adds a pose parameter with the range [lo, hi], in any spelling.
  void range(const std::string& name, const Rational& lo, const Rational& hi);
  /// Adds a pose parameter with a range whose interior contains `p`.
  void range_around(const std::string& name, const Rational& p);
  /// Adds a pose parameter with one value.
  void value(const std::string& name, const Rational& p);
  /// Adds a pose parameter; the expressions `from`, `to` are its ends; lo and hi are inside them.
  void range_of(const std::string& name, const std::string& from, const std::string& to,
                const Rational& lo, const Rational& hi);
  /// Lets the motion go through these points, a value for each pose parameter.
  ///
  /// Requires  decimals that end.
  void follow(const std::vector<std::vector<Rational>>& points);
  /// Adds a control error of at most `size`.
  void error(const std::string& name, const Rational& size);
  /// Adds an uncertain constant v ± t.
  void uncertain(const std::string& name, const Rational& v, const Rational& t);

  /// Allows entries to contain this name, too.
  void mention(const std::string& name) { names_.push_back(name); }

  /// Makes the matrix. Its determinant is `factor` times a nonzero constant, and every entry may
  /// depend on everything. `plain`: the constant is 1 or −1.
  void hide(const std::string& factor, bool plain = false);
  /// Does the same with several factors; all but the first have magnitudes of at least 1.
  void hide_all(std::vector<std::string> factors);

  // These functions state the truth. Call them after `hide`.
  void singular(Planted at, bool decidable = false);
  /// `lower`: a lower bound of |factor| − alpha.
  void regular(const Rational& lower, bool decidable = false);
  void undefined(Planted at, bool or_singular = false);
  /// States regular by `excess` if that is > 0; otherwise singular at `at`, a point of the variety.
  void decide(const Rational& excess, const Planted& at);

  Attack finish();

 private:
  Rational constant_ = Rational(1);
  std::vector<std::string> names_;  ///< entries may contain these
};

}  // namespace regulus::detail::attack
