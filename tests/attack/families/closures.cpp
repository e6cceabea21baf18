// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanisms that are given by equations: a branch of g(u) = x, with a second unknown v, both hidden
// behind a linear map. The oracle knows u; the command must find it.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// A function of u that is monotone between `low` and `high`, with its derivative.
struct Branch {
  std::string value, slope;  ///< expressions of u
  Rational low, high;
  bool is_singular = false;  ///< the slope is 0 at `at`
  Rational at, margin;       ///< regular: the slope is at least that
  Rational (*exact)(const Rational& u, const Rational& a);
  Rational parameter;
};

Rational cubic(const Rational& u, const Rational& a) { return u * u * u - Rational(3) * a * a * u; }
Rational flat(const Rational& u, const Rational& c) { return u * u * u + c * u; }
Rational square(const Rational& u, const Rational& d) { return u * u - d * d; }

Rational part(Builder& b) { return Rational(b.random.between(1, 15), 16); }

/// u³ − 3a²u falls between its folds at ±a.
Branch between_folds(Builder& b) {
  const Rational a = Rational(b.random.between(1, 40), 8);
  Branch branch{"u^3 - 3*" + b.text(a * a) + "*u",
                "3*u^2 - 3*" + b.text(a * a),
                -a * part(b),
                a,
                b.coin(),
                a,
                Rational(0),
                cubic,
                a};
  if (!branch.is_singular) {
    branch.high = a * (Rational(1) - Rational(b.random.between(1, 9)) *
                                         Rational::ten_to(-b.random.between(1, 7)));
    branch.margin = Rational(3) * (a - branch.high) * (a + branch.low);
  }
  return branch;
}

/// u³ + cu is nearly singular at 0, and singular for c = 0, where the branch goes on.
Branch through_a_flat_place(Builder& b) {
  const Rational c = b.coin() ? Rational(0) : Rational::ten_to(-b.random.between(1, 12));
  return {"u^3 + " + b.text(c) + "*u",
          "3*u^2 + " + b.text(c),
          -part(b),
          part(b),
          c.is_zero(),
          Rational(0),
          c,
          flat,
          c};
}

/// u² − d² for u > 0: the mirrored branch is −u.
Branch beside_its_mirror(Builder& b) {
  const Rational d = Rational(b.random.between(1, 16), 8), high = d * (Rational(1) + part(b));
  const bool is_singular = b.coin();
  const Rational low = is_singular ? Rational(0) : d * Rational::ten_to(-b.random.between(1, 7));
  return {"u^2 - " + b.text(d * d), "2*u",  low, high, is_singular, Rational(0),
          Rational(2) * low,        square, d};
}

/// (u, v) = M·(p, q) with whole numbers; M is regular.
struct Map {
  long a, b, c, d;
  [[nodiscard]] Rational determinant() const { return Rational(a * d - b * c); }
};

Map map_of(Builder& b) {
  Map m{};
  do {
    m = {b.random.between(-3, 3), b.random.between(-3, 3), b.random.between(-3, 3),
         b.random.between(-3, 3)};
  } while (m.determinant().is_zero());
  return m;
}

std::string combined(long p, long q) {
  return "(" + std::to_string(p) + "*p + " + std::to_string(q) + "*q)";
}

std::string with_u(const std::string& text, const std::string& u) {
  std::string result;
  for (const char c : text) result += c == 'u' ? u : std::string(1, c);
  return result;
}

/// A way from `start` to both ends of the range, with turns between them.
std::vector<std::vector<Rational>> way_to_ends(Builder& b, const Rational& start,
                                               const Rational& low, const Rational& high) {
  std::vector<std::vector<Rational>> points{{start}};
  const auto go_to = [&](const Rational& x) {
    if (points.back().front() != x) points.push_back({x});
  };
  const bool is_low_first = b.coin();
  for (const Rational& end : {is_low_first ? low : high, is_low_first ? high : low}) {
    for (long turns = b.random.between(0, 2); turns > 0; --turns)
      go_to(low + (high - low) * part(b));
    go_to(end);
  }
  return points;
}

Attack mechanism(Builder& b, bool is_along_way) {
  const Branch branch =
      b.random.pick(std::vector{between_folds, through_a_flat_place, beside_its_mirror})(b);
  const Map m = map_of(b);
  const std::string u = combined(m.a, m.b), v = combined(m.c, m.d);
  // v³ + v increases, so it has one value for each u.
  const Rational u0 = (branch.low + branch.high) / Rational(2),
                 v0 = Rational(b.random.between(-8, 8), 4);
  const Rational k(b.random.between(-2, 2));
  const std::string first = with_u(branch.value, u) + " - x";
  const std::string second = v + "^3 + " + v + " - " + b.text(v0 * v0 * v0 + v0) + " + " +
                             b.text(k) + "*(" + u + " - " + b.text(u0) + ")";
  const Rational x0 = branch.exact(u0, branch.parameter),
                 x1 = branch.exact(branch.low, branch.parameter),
                 x2 = branch.exact(branch.high, branch.parameter);
  Rational low = x1 < x2 ? x1 : x2, high = x1 < x2 ? x2 : x1;
  // Beyond a fold there is no configuration: the branch reaches it all the same.
  if (branch.is_singular && branch.at == branch.high && b.coin()) low -= Rational(1, 8);
  if (branch.is_singular && branch.at == branch.low && b.coin()) low -= Rational(1, 8);
  const Rational det = m.determinant(), p0 = (Rational(m.d) * u0 - Rational(m.b) * v0) / det,
                 q0 = (Rational(m.a) * v0 - Rational(m.c) * u0) / det;
  ModelSource& model = b.attack.model;
  model.pose.push_back(
      {"x", "[" + quoted(b.text(low)) + ", " + quoted(b.text(high)) + "]", branch.value});
  if (is_along_way) {
    const Rational error = b.coin() ? Rational(0) : (high - low) / Rational(64);
    if (!error.is_zero()) model.error.push_back({"x", spell_toml(error, b.random)});
    b.follow(way_to_ends(b, x0, low + error, high - error));
  }
  model.rows = {{{branch.slope}}};
  const Rational room = (branch.high - branch.low) / Rational(1000);
  model.closure = {
      {"unknowns", "{ p = \"m\", q = \"m\" }"},
      {"equations",
       "[" + quoted(first + " + " + b.text(k) + "*(" + second + ")") + ", " + quoted(second) + "]"},
      {"start", "{ x = " + quoted(b.text(x0)) + ", p = " + quoted(b.text(p0)) +
                    ", q = " + quoted(b.text(q0)) + " }"},
      {"radius", "{ p = " + quoted(b.text(room)) + ", q = " + quoted(b.text(room)) + " }"}};
  b.attack.axes.push_back({"u", branch.low, branch.high});
  if (branch.is_singular)
    b.singular({{"u", b.text(branch.at)}});
  else
    b.regular(branch.margin);
  b.attack.argument = branch.is_singular ? "the slope is 0 there" : "the slope has one sign";
  return b.finish();
}

}  // namespace

Attack closure(std::uint64_t seed) {
  Builder b("closure", seed);
  return mechanism(b, false);
}

Attack closure_along_way(std::uint64_t seed) {
  Builder b("closure_way", seed);
  return mechanism(b, true);
}

}  // namespace regulus::detail::attack
