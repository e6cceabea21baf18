// SPDX-License-Identifier: GPL-3.0-or-later
// Uncertain quantities whose range ends at the value that decides.
#include <array>

#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// Returns a tolerance that is small against 1.
Rational width(Builder& b) {
  return Rational(b.random.between(1, 99)) * Rational::ten_to(-b.random.between(2, 3));
}

}  // namespace

Attack tolerance_box(std::uint64_t seed) {
  Builder b("tolerance", seed);
  const Rational u = b.positive() + Rational(2), v = b.positive() + Rational(2), s = width(b),
                 t = width(b), excess = b.excess(60), p = b.number();
  b.range_around("x", p);
  b.uncertain("u", u, s);
  const std::string dx = minus("x", b.text(p));
  Planted at{{"x", b.text(p)}};
  switch (b.random.below(4)) {
    case 0:  // one constant at its upper end
      b.hide(b.text(u + s + excess) + " - u");
      at["u"] = b.text(u + s + excess);
      break;
    case 1:  // a constant, and a square that vanishes with it
      b.hide("u - " + b.text(u - s - excess) + " + " + dx + "^2");
      at["u"] = b.text(u - s - excess);
      break;
    case 2: {  // a product at its largest
      b.uncertain("v", v, t);
      const Rational most = (u + s) * (v + t);
      b.hide(b.text(most + excess) + " - u*v");
      at["u"] = b.text((most + excess) / (v + t));
      at["v"] = b.text(v + t);
      break;
    }
    default: {  // a sum at its least
      b.uncertain("v", v, t);
      const Rational a = b.positive(), c = b.positive();
      const Rational least = a * (u - s) + c * (v - t) - excess;
      b.hide(b.text(a) + "*u + " + b.text(c) + "*v - " + b.text(least) + " + 3*" + dx + "^2");
      at["u"] = b.text((least - c * (v - t)) / a);
      at["v"] = b.text(v - t);
    }
  }
  b.decide(excess, at);
  b.attack.argument = "an extremum over the tolerances";
  return b.finish();
}

Attack tolerance_ball(std::uint64_t seed) {
  Builder b("ball", seed);
  constexpr std::array<std::array<long, 4>, 5> kNormals = {
      {{3, 4, 0, 5}, {1, 2, 2, 3}, {2, 3, 6, 7}, {1, -4, 8, 9}, {-5, 12, 0, 13}}};
  const auto& normal = kNormals[b.random.below(kNormals.size())];
  const Rational radius = width(b), excess = b.excess(60), length(normal[3]), p = b.number();
  b.range_around("x", p);
  BallOfAxes ball{{}, {}, radius};
  std::string value = "[", plane;
  Rational offset;
  const std::size_t dimension = normal[2] == 0 ? 2 : 3;
  for (std::size_t i = 0; i < dimension; ++i) {
    const Rational centre = b.number();
    const std::string name = "c_" + std::to_string(i + 1);
    ball.axes.push_back(name);
    ball.centre.push_back(centre);
    b.attack.axes.push_back({name, centre - radius, centre + radius});
    b.mention(name);
    value += (i > 0 ? ", " : "") + spell_toml(centre, b.random);
    plane += (i > 0 ? " + " : "") + b.text(Rational(normal[i])) + "*" + name;
    offset += Rational(normal[i]) * centre;
  }
  b.attack.model.geometry.push_back(
      {"c", "{ value = " + value + "], radius = " + spell_toml(radius, b.random) + " }"});
  // The distance of the plane from the centre is radius + excess/length.
  const Rational reach = (radius * length + excess) / (length * length);
  std::string factor = plane + " - " + b.text(offset + radius * length + excess);
  if (b.coin()) factor += " - " + minus("x", b.text(p)) + "^2";
  b.hide(factor);
  Planted at{{"x", b.text(p)}};
  for (std::size_t i = 0; i < dimension; ++i)
    at[ball.axes[i]] = b.text(ball.centre[i] + reach * Rational(normal[i]));
  b.decide(excess, at);
  b.attack.balls.push_back(std::move(ball));
  b.attack.argument = "the distance of a plane from the centre of the ball";
  return b.finish();
}

Attack control_error(std::uint64_t seed) {
  Builder b("error", seed);
  const Rational p = b.number(), q = b.number(), e = width(b), d = width(b), excess = b.excess(60);
  Planted at;
  switch (b.random.below(3)) {
    case 0:  // one pose
      b.value("x", p);
      b.error("x", e);
      b.hide("x - " + b.text(p + e + excess));
      at = {{"x_error", b.text(e + excess)}};
      break;
    case 1: {  // two errors
      b.value("x", p);
      b.value("y", q);
      b.error("x", e);
      b.error("y", d);
      const Rational a = b.positive(), c = b.positive();
      const Rational most = a * (p + e) + c * (q + d) + excess;
      b.hide(b.text(a) + "*x + " + b.text(c) + "*y - " + b.text(most));
      at = {{"x_error", b.text(e + excess / a)}, {"y_error", b.text(d)}};
      break;
    }
    default: {  // beside the end of a range
      const Rational hi = p + Rational(1);
      b.range("x", p, hi);
      b.error("x", e);
      b.hide(b.text(hi + e + excess) + " - x");
      at = {{"x", b.text(hi)}, {"x_error", b.text(e + excess)}};
    }
  }
  b.decide(excess, at);
  b.attack.argument = "the end of the range with its error";
  return b.finish();
}

}  // namespace regulus::detail::attack
