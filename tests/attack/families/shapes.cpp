// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices with more rows than columns, and dense products.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// Returns a combination of two rows.
std::vector<Cell> combined(Builder& b, const std::vector<Cell>& u, const std::vector<Cell>& v) {
  const std::string r = b.text(b.number()), s = b.text(b.number());
  std::vector<Cell> row;
  for (std::size_t j = 0; j < u.size(); ++j)
    row.push_back({r + "*(" + u[j].text + ") + " + s + "*(" + v[j].text + ")"});
  return row;
}

/// Makes a matrix from f1 and f2, never both 0: Σ minors² ≥ f1² + f2² up to a factor.
void two_factors(Builder& b, const std::string& f1, const std::string& f2) {
  auto& rows = b.attack.model.rows;
  if (b.coin()) {
    rows = {{{f1}}, {{f2}}};
    return;
  }
  const std::string k = b.random.pick({"1", "2", "(-1/3)", "x"}),
                    a = b.random.pick({"3", "x", "0"});
  rows = {
      {{f1}, {k + "*(" + f1 + ")"}}, {{f2}, {k + "*(" + f2 + ")"}}, {{a}, {"1 + " + k + "*" + a}}};
  std::swap(rows[b.random.below(3)], rows[b.random.below(3)]);
}

}  // namespace

Attack rectangular(std::uint64_t seed) {
  Builder b("rectangular", seed);
  const Rational p = b.number(), gap = b.excess(40);
  b.range_around("x", p);
  const std::string dx = minus("x", b.text(p));
  if (b.random.one_in(3)) {
    two_factors(b, dx, "x - " + b.text(p + gap));
    if (gap.is_zero())
      b.singular({{"x", b.text(p)}});
    else
      b.regular(gap * gap * Rational(1, 2));
    b.attack.argument = "two factors with different roots";
    return b.finish();
  }
  if (b.coin()) {
    b.hide(b.random.pick({"", "2*"}) + dx + b.random.pick({"", "^2"}));
    b.singular({{"x", b.text(p)}});
  } else {
    const Rational m = b.margin(40);
    b.hide(dx + "^2 + " + b.text(m));
    b.regular(m);
    b.attack.margin = b.attack.margin * b.attack.margin;
  }
  auto& rows = b.attack.model.rows;
  const std::size_t square = rows.size(), more = 1 + b.random.below(3);
  for (std::size_t i = 0; i < more; ++i) {
    const std::size_t u = b.random.below(square), v = b.random.below(square);
    rows.push_back(combined(b, rows[u], rows[v]));
  }
  b.attack.argument = "rows that are combinations of others";
  return b.finish();
}

Attack composition(std::uint64_t seed) {
  Builder b("composition", seed);
  const Rational p = b.number(), q = b.number(), excess = b.coin() ? Rational(0) : b.margin(30);
  const std::vector<std::pair<const char*, Rational>> point{{"x", p}, {"y", q}};
  Planted at;
  for (const auto& [name, centre] : point) {
    b.range(name, centre - Rational(1, 20), centre + Rational(1, 20));
    at[name] = b.text(centre);
  }
  // h vanishes at the point and is small on the box, since p and q are at most 20.
  const std::string h = b.random.pick({"(x*y - #)", "(x^2 + y - #)", "(x - y - #)", "(x*y^2 - #)"});
  const Rational value = h == "(x*y - #)"       ? p * q
                         : h == "(x^2 + y - #)" ? p * p + q
                         : h == "(x - y - #)"   ? p - q
                                                : p * q * q;
  std::string inner = h;
  inner.replace(inner.find('#'), 1, b.text(value));
  std::string factor;
  const bool crossing = b.coin();
  if (crossing) {
    factor = b.random.pick({"atan", "exp(-1 + 1)*", "2*", "0.5*"}) + inner;
    b.hide(factor);
    b.singular(at, true);
  } else {
    factor = b.random.pick({"1 - 1/(1 + #^2)", "sqrt(1 + #^2) - 1", "abs#", "#^2", "log(1 + #^2)",
                            "atan(#^2)", "asin(#^2/(1 + #^2))"});
    for (std::size_t i; (i = factor.find('#')) != std::string::npos;) factor.replace(i, 1, inner);
    if (excess.sign() > 0) factor += " + " + b.text(excess);
    b.hide(factor);
    b.decide(excess, at);
  }
  // The determinant has more factors.
  b.attack.argument = "a composition that vanishes with its innermost part";
  return b.finish();
}

}  // namespace regulus::detail::attack
