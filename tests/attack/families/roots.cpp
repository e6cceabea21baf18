// SPDX-License-Identifier: GPL-3.0-or-later
// Determinants with a known root.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// Returns x² − 2px + p² + rest.
std::string expanded_square(Builder& b, const std::string& x, const Rational& p,
                            const Rational& rest) {
  return x + "^2 - " + b.text(Rational(2) * p) + "*" + x + " + " + b.text(p * p + rest);
}

/// Returns a function that vanishes with d, and nowhere else if |d| is moderate.
std::string odd(Builder& b, const std::string& d) {
  switch (b.random.below(7)) {
    case 0:
      return d + "^3";
    case 1:
      return "sin" + d;
    case 2:
      return "exp" + d + " - 1";
    case 3:
      return "atan" + d;
    case 4:
      return d + "*(2 + x^2)";
    default:
      return d;
  }
}

std::string factor_with_root(Builder& b, const Rational& p, const Rational& q) {
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  switch (b.random.below(5)) {
    case 0:
      return b.text(b.number()) + "*" + dx + " + " + b.text(b.number()) + "*" + dy;
    case 1:
      return "x*y - " + b.text(p * q);
    case 2:
      return "x^3 - " + b.text(p * p * p);
    case 3:
      return "x^2 + x - " + b.text(p * p + p) + " + " + dx + "*" + dy;
    default:
      return odd(b, dx);
  }
}

}  // namespace

Attack singular_in_the_interior(std::uint64_t seed) {
  Builder b("interior", seed);
  const Rational p = b.number(), q = b.number();
  b.range_around("x", p);
  b.range_around("y", q);
  b.hide(factor_with_root(b, p, q));
  b.singular({{"x", b.text(p)}, {"y", b.text(q)}}, true);
  b.attack.argument = "the factor vanishes at the point";
  return b.finish();
}

Attack singular_on_an_edge(std::uint64_t seed) {
  Builder b("edge", seed);
  const Rational p = b.number(), q = b.number(), width = b.positive();
  const bool lower = b.coin();
  b.range("x", lower ? p : p - width, lower ? p + width : p);
  b.range_around("y", q);
  b.hide(odd(b, minus("x", b.text(p))) + (b.coin() ? "" : " + 0*y"));
  b.singular({{"x", b.text(p)}, {"y", b.text(q)}});
  b.attack.argument = "the factor vanishes at an end of x";
  return b.finish();
}

Attack singular_at_a_corner(std::uint64_t seed) {
  Builder b("corner", seed);
  const std::size_t dimension = 2 + b.random.below(2);
  std::string sum;
  Planted corner;
  for (const char* x : {"x", "y", "z"}) {
    if (corner.size() == dimension) break;
    const Rational p = b.number(), width = b.positive();
    const bool lower = b.coin();
    b.range(x, lower ? p : p - width, lower ? p + width : p);
    const std::string from = lower ? minus(x, b.text(p)) : minus(b.text(p), x);
    sum += (sum.empty() ? "" : " + ") + b.text(b.positive()) + "*" + from + (b.coin() ? "" : "^3");
    corner[x] = b.text(p);
  }
  b.hide(sum);
  b.singular(corner);
  b.attack.argument = "a sum of terms that are 0 at one corner together, positive elsewhere";
  return b.finish();
}

Attack double_root(std::uint64_t seed) {
  Builder b("double", seed);
  const Rational p = b.number(), q = b.number();
  b.range_around("x", p);
  b.range_around("y", q);
  const Rational a = b.number(), c = b.number();
  const std::string line =
      "(" + b.text(a) + "*x + " + b.text(c) + "*y - " + b.text(a * p + c * q) + ")";
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  switch (b.random.below(6)) {
    case 0:
      b.hide(expanded_square(b, "x", p, 0));
      break;
    case 1:
      b.hide(expanded_square(b, "x", p, 0) + " + " + expanded_square(b, "y", q, 0));
      break;
    case 2:
      b.hide(line + "^2");
      break;
    case 3:
      b.hide(dx + "^4 + " + dy + "^2");
      break;
    case 4:
      b.hide("abs" + dx);
      break;
    default:
      b.hide("1 - cos" + dx + " + " + dy + "^2");
  }
  b.singular({{"x", b.text(p)}, {"y", b.text(q)}});
  b.attack.argument = "a square that vanishes at the point";
  return b.finish();
}

Attack regular_by_a_margin(std::uint64_t seed) {
  Builder b("margin", seed);
  const Rational p = b.number(), q = b.number();
  b.range("x", p - Rational(1), p + Rational(1));
  const bool two = b.coin();
  if (two) b.range_around("y", q);
  const std::string rest = two ? " + " + minus("y", b.text(q)) + "^2" : "";
  Planted at;
  if (two) at["y"] = b.text(q);
  if (b.random.one_in(4)) {
    const Rational root = b.margin(150);  // f = (x − p)² − root²
    b.hide(expanded_square(b, "x", p, -root * root) + rest);
    at["x"] = b.text(p + root);
    b.singular(at);
  } else {
    const Rational m = b.margin();
    b.hide(
        (b.coin() ? expanded_square(b, "x", p, m) : minus("x", b.text(p)) + "^2 + " + b.text(m)) +
        rest);
    b.regular(m);
  }
  b.attack.argument = "a sum of squares plus or minus the margin";
  return b.finish();
}

Attack linear_margin(std::uint64_t seed) {
  Builder b("linear", seed);
  const Rational p = b.number(), excess = b.excess();
  const Rational width = Rational(b.random.between(1, 30), 10);
  const bool lower = b.coin();
  b.range("x", lower ? p : p - width, lower ? p + width : p);
  // The distance is 0 at −excess from the end.
  const std::string constant = b.text(lower ? excess - p : excess + p);
  const std::string factor = lower ? "x + " + constant : constant + " - x";
  b.hide(b.coin() ? factor : "(" + factor + ")*(x^2 + 1)");
  b.decide(excess, {{"x", b.text(lower ? p - excess : p + excess)}});
  b.attack.argument = "linear, 0 beside the end or beyond it";
  return b.finish();
}

Attack expanded_polynomial(std::uint64_t seed) {
  Builder b("polynomial", seed);
  const std::size_t degree = 2 + b.random.below(6);
  std::vector<Rational> coefficients{Rational(1)}, roots;
  while (roots.size() < degree) {
    const Rational root = roots.empty() || !b.random.one_in(4)
                              ? Rational(b.random.between(-20, 20),
                                         static_cast<unsigned long>(b.random.between(1, 7)))
                              : roots.back();
    roots.push_back(root);
    coefficients.insert(coefficients.begin(), Rational(0));
    for (std::size_t i = 0; i + 1 < coefficients.size(); ++i)
      coefficients[i] -= root * coefficients[i + 1];
  }
  std::string sum;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (coefficients[i].is_zero()) continue;
    sum += (sum.empty() ? "" : " + ") + b.text(coefficients[i]) + "*x^" + std::to_string(i);
  }
  // The range begins to the right of a root and ends before the next one.
  const Rational root = b.random.pick(roots), gap = b.excess(100);
  Rational next = root + Rational(2);
  for (const Rational& r : roots)
    if (r > root && r < next) next = r;
  const Rational lo = root + gap, hi = (root + next) * Rational(1, 2);
  b.range("x", lo, hi);
  b.hide(sum);
  if (gap.sign() <= 0) {
    b.singular({{"x", b.text(root)}});
  } else {
    Rational least(1);
    for (const Rational& r : roots)
      least *= r <= root ? (lo - r).magnitude() : (r - hi).magnitude();
    b.regular(least);
  }
  b.attack.argument = "multiplied out from its rational roots";
  return b.finish();
}

Attack identity(std::uint64_t seed) {
  Builder b("identity", seed);
  b.range("x", Rational(1, 10), Rational(b.random.between(3, 9), 10));
  b.range("y", Rational(1, 10), Rational(b.random.between(3, 9), 10));
  std::string zero = b.random.pick(
      {"sin(x)^2 + cos(x)^2 - 1", "(x + y)^2 - x^2 - 2*x*y - y^2", "sin(2*x) - 2*sin(x)*cos(x)",
       "exp(x)*exp(-x) - 1", "sqrt(x^2) - abs(x)", "log(exp(x)) - x", "tan(x)*cos(x) - sin(x)",
       "acos(x) + asin(x) - pi/2", "atan2(y, x) - atan(y/x)", "sqrt(x)*sqrt(y) - sqrt(x*y)",
       "cos(x + y) - cos(x)*cos(y) + sin(x)*sin(y)", "x - x", "0", "(x - y)*(x + y) - x^2 + y^2",
       "exp(x + y) - exp(x)*exp(y)", "x/y*y - x", "log(x*y) - log(x) - log(y)", "asin(sin(x)) - x",
       "abs(x) - x"});
  const Rational excess = b.random.one_in(2) ? Rational(0) : b.margin();
  if (excess.sign() > 0) zero += " + " + b.text(excess);
  b.hide(zero);
  b.decide(excess, {{"x", "0.2"}, {"y", "0.25"}});
  b.attack.argument = "an identity, plus a constant or not";
  return b.finish();
}

}  // namespace regulus::detail::attack
