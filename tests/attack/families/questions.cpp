// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds, scales, constraints and parametric motions.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

void set_alpha(Builder& b, const Rational& alpha) {
  b.attack.alpha = alpha;
  if (b.random.one_in(3))
    b.attack.options.insert(b.attack.options.end(), {"--alpha", spell_option(alpha, b.random)});
  else
    b.attack.model.alpha = spell_toml(alpha, b.random);
}

/// A direction with a rational length.
struct Direction {
  long a, c, length;
};
constexpr Direction kDirections[] = {{3, 4, 5}, {5, 12, 13}, {-8, 15, 17}, {20, -21, 29}};

}  // namespace

Attack threshold(std::uint64_t seed) {
  Builder b("threshold", seed);
  const Rational least = b.positive(), excess = least * b.excess(40);  // excess of the least |det|
  const Rational p = b.number();
  Rational scale(1);
  std::string factor;
  if (b.coin()) {
    b.range_around("x", p);
    factor = minus("x", b.text(p)) + "^2 + " + b.text(least);
  } else {
    b.range("x", p, p + b.positive());
    factor = minus("x", b.text(p)) + " + " + b.text(least);
  }
  if (b.coin()) factor = "-(" + factor + ")";
  b.hide(factor, true);
  if (b.coin()) {
    scale = b.positive();
    const std::size_t rows = b.attack.model.rows.size(), at = b.random.below(rows);
    for (std::size_t i = 0; i < rows; ++i)
      b.attack.model.row_scale.push_back({i == at ? b.text(scale) : "1"});
  }
  set_alpha(b, scale * (least - excess));
  b.decide(scale * excess, {{"x", b.text(p)}});
  b.attack.argument = "alpha at the least |det|, above or below it";
  return b.finish();
}

Attack row_scale(std::uint64_t seed) {
  Builder b("scale", seed);
  const Rational p = b.number(), width(b.random.between(1, 30), 10), m = b.margin();
  const std::size_t kind = b.random.below(4);
  const Rational lo = kind == 0 ? p - width : kind == 1 ? p : p + m;
  b.range("x", lo, p + width + m);
  b.hide("2 + sin(x)");
  const std::size_t rows = b.attack.model.rows.size(), at = b.random.below(rows);
  const std::string d = minus("x", b.text(p));
  const std::string scale = kind < 3 ? b.random.pick({"", "3*", "1e-30*", "1e30*"}) + d : "1/" + d;
  for (std::size_t i = 0; i < rows; ++i)
    b.attack.model.row_scale.push_back({i == at ? scale : i == 0 ? "1e-3" : "1"});
  if (kind < 2)
    b.undefined({{"x", b.text(p)}}, true);
  else
    b.regular(0);
  b.attack.argument = "a scale must be positive";
  return b.finish();
}

/// Two pieces, with different signs.
void two_pieces(Builder& b, const Rational& p, const Rational& q) {
  const std::string dx = minus("x", b.text(p));
  const Rational gap = b.coin() ? Rational(1, 10) : b.margin(20);
  b.range("x", p - Rational(1), p + Rational(1));
  b.range_around("y", q);
  b.attack.model.constraints.push_back(b.text(gap * gap) + " - " + dx + "^2");
  b.hide(dx);
  b.regular(gap);
}

void disc_and_line(Builder& b, const Rational& p, const Rational& q, const Rational& excess) {
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  const Direction& n = kDirections[b.random.below(std::size(kDirections))];
  const Rational a(n.a), c(n.c), length(n.length), radius(b.random.between(1, 9), 4);
  b.range("x", p - Rational(3), p + Rational(3));
  b.range("y", q - Rational(3), q + Rational(3));
  b.attack.model.constraints.push_back(dx + "^2 + " + dy + "^2 - " + b.text(radius * radius));
  b.hide(b.text(a) + "*" + dx + " + " + b.text(c) + "*" + dy + " - " +
         b.text(radius * length + excess));
  const Rational t = (radius * length + excess) / (length * length);
  b.decide(excess, {{"x", b.text(p + t * a)}, {"y", b.text(q + t * c)}});
}

Attack constraint(std::uint64_t seed) {
  Builder b("constraint", seed);
  std::vector<std::string>& constraints = b.attack.model.constraints;
  const Rational p = b.number(), q = b.number(), excess = b.excess(40);
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  switch (b.random.below(5)) {
    case 0:
      two_pieces(b, p, q);
      break;
    case 1: {  // one point
      b.range("x", p - Rational(1), p + Rational(1));
      b.range("y", q - Rational(1), q + Rational(1));
      constraints.push_back(dx + "^2 + " + dy + "^2");
      const Rational offset = b.coin() ? Rational(0) : b.margin(20);
      b.hide(dx + " + " + b.text(offset));
      b.decide(offset, {{"x", b.text(p)}, {"y", b.text(q)}});
      b.attack.planted = {{"x", b.text(p)}, {"y", b.text(q)}};
      b.attack.sampled = false;
      break;
    }
    case 2:  // cut at the root or beside it
      b.range("x", p - Rational(1), p + Rational(1));
      constraints.push_back(dx);
      b.hide("x - " + b.text(p + excess));
      b.decide(excess, {{"x", b.text(p + excess)}});
      break;
    case 3:
      disc_and_line(b, p, q, excess);
      break;
    default:  // rings: the root is in the hole
      b.range("x", p - Rational(1), p + Rational(1));
      b.range("y", q - Rational(1), q + Rational(1));
      constraints.push_back("1/4 - " + dx + "^2 - " + dy + "^2");
      b.hide(dx + "^2 + " + dy + "^2 - " + b.text(Rational(1, 4) - excess));
      b.decide(excess, {{"x", b.text(p + Rational(1, 2))}, {"y", b.text(q)}});
      if (excess.sign() < 0) {  // no root has rational coordinates; the sign changes
        b.attack.planted = {{"x", b.text(p + Rational(1, 2))}, {"y", b.text(q)}};
        b.attack.other_sign = {{"x", b.text(p + Rational(1))}, {"y", b.text(q)}};
      }
  }
  b.attack.argument = "what the constraint leaves";
  return b.finish();
}

Attack empty_variety(std::uint64_t seed) {
  Builder b("empty", seed);
  const Rational p = b.number(), m = b.margin(40);
  b.range("x", p - Rational(1), p + Rational(1));
  b.range_around("y", p);
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(p));
  std::vector<std::string>& constraints = b.attack.model.constraints;
  switch (b.random.below(6)) {
    case 0:
      constraints = {"1 + x^2"};
      break;
    case 1:
      constraints = {dx + "^2 + " + b.text(m)};
      break;
    case 2:
      constraints = {"x - " + b.text(p), b.text(p + m) + " - x"};
      break;
    case 3:
      constraints = {dx + "^2 + " + dy + "^2 + " + b.text(m)};
      break;
    case 4:
      constraints = {"x - " + b.text(p - Rational(2))};
      break;
    default:
      constraints = {"2 + sin(x*y)", "y"};
  }
  b.hide(b.random.pick({"x", "2 + sin(x)", "1"}) + (b.coin() ? "" : " + y"));
  b.attack.truth = Truth::kEmpty;
  b.attack.argument = "some constraint is positive at every pose";
  return b.finish();
}

void pose_of(Builder& b, const std::string& x, const std::string& y) {
  b.attack.model.pose = {{"x", '"' + x + '"', x}, {"y", '"' + y + '"', y}};
  for (const char* name : {"x", "y"}) b.mention(name);
}

void surface(Builder& b, const Rational& excess) {
  pose_of(b, "T*S", "T - S");
  b.attack.model.parameters = "{ T = [0, 1], S = [\"1/3\", 2] }";
  b.attack.axes = {{"T", 0, 1}, {"S", Rational(1, 3), 2}};
  b.hide("2 + " + b.text(excess) + " - x");
  b.decide(excess, {{"T", b.text(Rational(1) + excess * Rational(1, 2))}, {"S", "2"}});
}

Attack trajectory(std::uint64_t seed) {
  Builder b("trajectory", seed);
  ModelSource& model = b.attack.model;
  const Rational excess = b.excess(60);
  switch (b.random.below(6)) {
    case 0: {  // a line that ends beside the root
      const Rational a = b.number(), c = b.positive();
      pose_of(b, b.text(a) + " + " + b.text(c) + "*T", "T^2");
      b.hide("x - " + b.text(a + c + excess));
      b.decide(excess, {{"T", b.text(Rational(1) + excess / c)}});
      break;
    }
    case 1: {  // the vertex of a parabola
      const Rational root = b.margin(60);
      const bool below = excess.sign() < 0;
      pose_of(b, "T^2 - T", "T");
      b.hide("x + " + b.text(Rational(1, 4) + (below ? -root * root : excess)));
      b.decide(excess, {{"T", b.text(Rational(1, 2) + (below ? root : Rational(0)))}});
      break;
    }
    case 2:  // a circle and its tangent
      pose_of(b, "cos(2*pi*T)", "sin(2*pi*T)");
      b.hide("x - " + b.text(Rational(1) + excess));
      b.decide(excess, {{"T", "0"}});
      if (excess.sign() < 0) b.attack.other_sign = {{"T", "1/2"}};
      break;
    case 3:  // a line through the circle
      pose_of(b, "cos(2*pi*T)", "sin(2*pi*T)");
      b.hide("3*x + 4*y");
      b.singular({{"T", "0"}}, true);
      b.attack.other_sign = {{"T", "1/2"}};
      break;
    case 4: {  // the distance from the circle itself
      const Rational m = b.coin() ? Rational(0) : b.margin();
      pose_of(b, "cos(2*pi*T)", "sin(2*pi*T)");
      b.hide("x^2 + y^2 - " + b.text(Rational(1) - m));
      b.decide(m, {{"T", "1/3"}});
      break;
    }
    default:
      surface(b, excess);
  }
  if (model.parameters.empty()) {
    model.parameters = "{ T = [" + spell_toml(Rational(0), b.random) + ", " +
                       spell_toml(Rational(1), b.random) + "] }";
    b.attack.axes = {{"T", 0, 1}};
  }
  b.attack.argument = "the extremum along the motion";
  return b.finish();
}

}  // namespace regulus::detail::attack
