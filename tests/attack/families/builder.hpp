// SPDX-License-Identifier: GPL-3.0-or-later
// What the families have in common: choosing numbers, declaring quantities, hiding a determinant.
#pragma once

#include <string>
#include <vector>

#include "tests/attack/families/spelling.hpp"
#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::attack {

class Builder {
 public:
  Builder(const char* family, std::uint64_t seed);

  Random random;
  Attack attack;

  /// A rational: a small fraction, a decimal of up to 17 or 60 digits, a dyadic number.
  Rational number();
  /// The same, above 0.
  Rational positive();
  /// c·10^-k, k from 6 to `most`.
  Rational margin(long most = 300);
  /// 0, a margin, or a negative one.
  Rational excess(long most = 300);
  bool coin() { return random.one_in(2); }

  [[nodiscard]] std::string text(const Rational& value) { return spell_expression(value, random); }

  /// A pose parameter with the range [lo, hi], in any spelling.
  void range(const std::string& name, const Rational& lo, const Rational& hi);
  /// A range around `p`, which is in its interior.
  void range_around(const std::string& name, const Rational& p);
  /// A pose parameter with one value.
  void value(const std::string& name, const Rational& p);
  /// A pose parameter whose range has these ends, expressions; lo and hi lie in the range.
  void range_of(const std::string& name, const std::string& from, const std::string& to,
                const Rational& lo, const Rational& hi);
  /// An uncertain constant v ± t.
  void uncertain(const std::string& name, const Rational& v, const Rational& t);

  /// Lets entries contain this name, too.
  void mention(const std::string& name) { names_.push_back(name); }

  /// The matrix: `factor` times a nonzero constant is its determinant, where every entry of it may
  /// depend on everything. `plain`: the constant is 1 or −1.
  void hide(const std::string& factor, bool plain = false);
  /// The same with several factors, of which the rest have magnitudes of at least 1.
  void hide_all(std::vector<std::string> factors);

  // What is true, after `hide`.
  void singular(Planted at, bool decidable = false);
  /// `lower`: of |factor| − alpha.
  void regular(const Rational& lower, bool decidable = false);
  void undefined(Planted at, bool or_singular = false);
  /// Regular by `excess` if that is > 0; singular at `at` otherwise, which is then in the variety.
  void decide(const Rational& excess, const Planted& at);

  Attack finish();

 private:
  Rational constant_ = Rational(1);
  std::vector<std::string> names_;  ///< that entries may contain
};

}  // namespace regulus::attack
