// SPDX-License-Identifier: GPL-3.0-or-later
// Another form of the entries of a matrix, before its determinant is multiplied out: (x - c)² + m
// is at least m, which x² - 2cx + c² + m does not show.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

/// Keeps powers of sums in one piece, as symbols, and uses relations between functions:
/// √(fg) = √f·√g, log(fg) = log f + log g, tan u = sin u/cos u. A relation holds where its right
/// side is defined, which is why that side goes to `must_be_defined`.
class KeptPowers {
 public:
  /// `most`: how many different powers are kept; the others are multiplied out.
  explicit KeptPowers(std::size_t most) : most_(most) {}

  /// e with symbols in place of powers.
  ///
  /// Ensures   with `reveal`, the value of e wherever e and all of must_be_defined() are defined.
  [[nodiscard]] Expression hide(const Expression& e);
  /// The same with the powers in place of the symbols.
  [[nodiscard]] Expression reveal(const Expression& e) const;

  /// f·(1/f) is 1 wherever 1/f is defined, which then goes to must_be_defined.
  [[nodiscard]] Polynomial without_inverses(const Polynomial& p, const AtomTable& atoms);

  /// The symbols that `hide` may use.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const Expressions& must_be_defined() const noexcept { return must_be_defined_; }

 private:
  [[nodiscard]] std::optional<Expression> replacement(const Expression& e);
  [[nodiscard]] std::optional<Expression> kept(const Expression& e);
  [[nodiscard]] std::optional<Expression> related(const Expression& e);
  [[nodiscard]] Expression required(const Expression& e);

  std::size_t most_;
  Expressions powers_;
  Expressions must_be_defined_;
};

}  // namespace regulus::detail
