// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers whose last digit decides; ranges of extreme size.
#include <cstdio>

#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// Two decimals of up to 60 digits: `changed` is equal to `given`, or differs in its last digit or
/// a later one.
struct Pair {
  Rational given, changed;
};

std::string digits(Random& random, long count) {
  std::string text(1, static_cast<char>('1' + random.below(9)));
  while (static_cast<long>(text.size()) < count) text += static_cast<char>('0' + random.below(10));
  return text;
}

Rational printed_with_17_digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.16e", value);
  const std::string all(text);
  const std::size_t e = all.find('e');
  return Rational::decimal(all.substr(0, 1) + all.substr(2, e - 2),
                           std::stol(all.substr(e + 1)) - 16);
}

Pair pair_of_numbers(Builder& b) {
  Random& random = b.random;
  if (random.one_in(5)) {  // a short decimal, and the nearest double as a program prints it
    const long hundredths = random.between(1, 99999);
    return {Rational(hundredths, 1000),
            printed_with_17_digits(static_cast<double>(hundredths) / 1000)};
  }
  const long count = random.between(1, 60);
  const long exponent = random.one_in(4) ? random.between(-60, 10) : 1 - count;
  const Rational given = Rational::decimal(digits(random, count), exponent);
  if (random.one_in(3)) return {given, given};
  const Rational last = Rational::ten_to(exponent - random.between(0, 60 - count));
  return {given, given + (b.coin() ? last : -last)};
}

void option(Builder& b, const char* name, const std::string& value) {
  b.attack.options.insert(b.attack.options.end(), {name, value});
}

/// Uses the difference as the factor; 0 means singular at every pose.
void decide_by(Builder& b, const Rational& difference) {
  Planted at;
  for (const Axis& axis : b.attack.axes)
    at[axis.name] = b.text((axis.lo + axis.hi) * Rational(1, 2));
  if (difference.is_zero())
    b.singular(at);
  else
    b.regular(difference.magnitude());
}

void literal_in_a_pose(Builder& b, const Pair& n) {
  if (b.coin()) {
    b.attack.model.pose.push_back({"x", "7", b.text(n.given)});
    option(b, "--range", "x=" + spell_option(n.given, b.random));
  } else {
    b.value("x", n.given);
  }
  b.hide("x - " + b.text(n.changed));
  decide_by(b, n.given - n.changed);
}

void literal_in_an_end(Builder& b, const Pair& n) {
  const bool lower = b.coin();
  const Rational width(b.random.between(1, 9), 8);
  b.range("x", lower ? n.given : n.given - width, lower ? n.given + width : n.given);
  b.hide("x - " + b.text(n.changed));
  const Rational beyond = lower ? n.given - n.changed : n.changed - n.given;
  b.decide(beyond, {{"x", b.text(n.changed)}});
}

void literal_in_the_matrix(Builder& b, const Pair& n) {
  b.range("x", 0, 1);
  const auto bare = spell_bare(n.given, b.random);
  b.attack.model.rows = {{{bare.value_or(b.text(n.given)), bare.has_value()}, {b.text(n.changed)}},
                         {{"1", b.coin()}, {"1"}}};
  decide_by(b, n.given - n.changed);
}

void literal_in_the_geometry(Builder& b, const Pair& n) {
  b.range("x", 0, 1);
  std::string toml = spell_toml(n.given, b.random);
  if (b.coin()) toml = "{ value = " + toml + " }";
  b.attack.model.geometry.push_back({"u", toml});
  b.attack.axes.push_back({"u", n.given, n.given});
  b.hide("u - " + b.text(n.changed));
  decide_by(b, n.given - n.changed);
}

void literal_in_a_tolerance(Builder& b, const Pair& n) {
  const Rational u = b.number();
  b.range("x", 0, 1);
  b.uncertain("u", u, n.given);
  b.hide("u - " + b.text(u + n.changed));
  b.decide(n.changed - n.given, {{"x", "0"}, {"u", b.text(u + n.changed)}});
}

void literal_in_an_error(Builder& b, const Pair& n) {
  b.value("x", 0);
  b.attack.model.error.push_back({"x", spell_toml(n.given, b.random)});
  b.attack.axes.push_back({"x_error", -n.given, n.given});
  b.hide("x - " + b.text(n.changed));
  b.decide(n.changed - n.given, {{"x_error", b.text(n.changed)}});
}

void literal_in_alpha(Builder& b, const Pair& n) {
  b.range("x", 0, 1);
  b.attack.alpha = n.given;
  if (b.coin())
    option(b, "--alpha", spell_option(n.given, b.random));
  else
    b.attack.model.alpha = spell_toml(n.given, b.random);
  if (b.coin()) {
    b.attack.model.rows = {{{"1"}}};
    const auto bare = spell_bare(n.changed, b.random);
    b.attack.model.row_scale = {{bare.value_or(b.text(n.changed)), bare.has_value()}};
  } else {
    b.hide(b.text(n.changed), true);
  }
  b.decide(n.changed - n.given, {{"x", "0"}});
}

void literal_in_a_parameter(Builder& b, const Pair& n) {
  b.attack.model.pose = {{"x", "\"2*T\"", "2*T"}};
  b.attack.model.parameters = "{ T = [-100, " + spell_toml(n.given, b.random) + "] }";
  b.attack.axes = {{"T", -100, n.given}};
  b.hide("x - " + b.text(Rational(2) * n.changed));
  b.decide(n.changed - n.given, {{"T", b.text(n.changed)}});
}

void literal_in_a_constraint(Builder& b, const Pair& n) {
  b.range("x", n.given - Rational(1), n.given + Rational(1));
  b.attack.model.constraints = {"x - " + b.text(n.given)};
  b.hide("x - " + b.text(n.changed));
  b.decide(n.changed - n.given, {{"x", b.text(n.changed)}});
}

void literal_in_a_let(Builder& b, const Pair& n) {
  b.range("x", 0, 1);
  b.attack.model.let.push_back({"c", b.text(n.given)});
  b.hide("c - " + b.text(n.changed));
  decide_by(b, n.given - n.changed);
}

/// Adds integers of 53 to 63 bits that differ by 1 or are equal.
void large_integer(Builder& b) {
  const Rational given =
      Rational::two_to(b.random.between(53, 62)) + Rational(b.random.between(-1000, 1000));
  const Rational changed = given + Rational(b.random.between(-1, 1));
  b.value("x", given);
  b.hide("x - " + b.text(changed));
  decide_by(b, given - changed);
}

/// Returns a double, or a number between two adjacent doubles.
Rational near_a_double(Builder& b, double at) {
  const Rational d = Rational::of(at);
  return b.coin() ? d : d + d.magnitude() * Rational::ten_to(-b.random.between(17, 40));
}

}  // namespace

Attack literal(std::uint64_t seed) {
  Builder b("literal", seed);
  const Pair n = pair_of_numbers(b);
  constexpr void (*kPlaces[])(Builder&, const Pair&) = {
      literal_in_a_pose,       literal_in_an_end,   literal_in_the_matrix, literal_in_the_geometry,
      literal_in_a_tolerance,  literal_in_an_error, literal_in_alpha,      literal_in_a_parameter,
      literal_in_a_constraint, literal_in_a_let};
  const std::size_t place = b.random.below(std::size(kPlaces) + 1);
  if (place == std::size(kPlaces))
    large_integer(b);
  else
    kPlaces[place](b, n);
  b.attack.argument = "two numbers that are the same, or differ in their last digit";
  return b.finish();
}

Attack thin(std::uint64_t seed) {
  Builder b("thin", seed);
  const Rational p = near_a_double(b, static_cast<double>(b.random.between(1, 1 << 20)) / 1024);
  const Rational q = b.number(), excess = b.excess();
  switch (b.random.below(4)) {
    case 0:  // a point
      b.value("x", p);
      b.value("y", q);
      b.hide("x*y - " + b.text(p * q) + " + " + b.text(excess));
      b.decide(excess.magnitude(), {});
      break;
    case 1: {  // a range with two equal ends
      b.range("x", p, p);
      b.hide("x^2 - " + b.text(p * p) + " + " + b.text(excess));
      b.decide(excess.magnitude(), {{"x", b.text(p)}});
      break;
    }
    case 2: {  // a range as wide as one step of doubles
      const Rational step = p * Rational::two_to(-52), root = p + step * Rational(1, 3);
      b.range("x", p, p + step);
      b.hide("x - " + b.text(root));
      b.singular({{"x", b.text(root)}});
      break;
    }
    default: {  // a root beside the range
      const Rational step = p * Rational::two_to(-60), gap = b.margin();
      b.range("x", p, p + step);
      b.hide("x - " + b.text(p - gap));
      b.regular(gap);
    }
  }
  b.attack.argument = "linear on a thin range";
  return b.finish();
}

Attack huge_or_subnormal(std::uint64_t seed) {
  Builder b("huge", seed);
  const bool huge = b.coin();
  const long exponent = huge ? b.random.between(40, 60) : -b.random.between(1000, 1080);
  const Rational unit = Rational::two_to(exponent);
  const Rational p = unit * Rational(b.random.between(2, 15), 16) +
                     (b.coin() ? Rational(0) : unit * Rational::ten_to(-b.random.between(3, 30)));
  const Rational lo = b.coin() ? Rational(0) : unit * Rational(1, 16);
  const Rational excess =
      Rational(b.random.between(-1, 1)) * unit * Rational::ten_to(-b.random.between(6, 40));
  // Writes numbers with fewer digits than fractions of powers of 2 have.
  const auto scaled = [&](const Rational& v) {
    return b.text(v / unit) + "*" + power_of_two(exponent);
  };
  b.range_of("x", scaled(lo), scaled(p), lo, p);
  const std::string factor = scaled(p + excess) + " - x";
  b.hide(b.coin() ? factor : "(" + factor + ")*" + power_of_two(-exponent));
  b.decide(excess, {{"x", scaled(p + excess)}});
  if (b.attack.truth == Truth::kRegular) b.attack.margin = Rational(0);
  b.attack.argument = "linear on a range of extreme size";
  return b.finish();
}

Attack badly_scaled(std::uint64_t seed) {
  Builder b("scaled", seed);
  const Rational p = b.number(), q = b.number(), excess = b.excess(30);
  b.range_around("x", p);
  b.range_around("y", q);
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  switch (b.random.below(3)) {
    case 0:
      b.hide(dx);
      b.singular({{"x", b.text(p)}, {"y", b.text(q)}}, true);
      break;
    case 1:
      b.hide("2 + " + dx + "^2");
      b.regular(1);
      break;
    default:
      b.hide(dx + "^2 + " + dy + "^2 + " + b.text(excess.magnitude()));
      b.decide(excess.magnitude(), {{"x", b.text(p)}, {"y", b.text(q)}});
  }
  auto& rows = b.attack.model.rows;
  const bool decimal = b.random.one_in(4);
  const auto factor = [&] {
    const long k = b.random.between(decimal ? -90 : -300, decimal ? 90 : 300);
    return decimal ? "1e" + std::to_string(k) : power_of_two(k);
  };
  const bool by_row = b.coin();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (b.random.one_in(3)) continue;
    const std::string f = factor();
    for (std::size_t j = 0; j < rows.size(); ++j) {
      Cell& cell = by_row ? rows[i][j] : rows[j][i];
      if (cell.text != "0") cell.text = "(" + cell.text + ")*" + f;
    }
  }
  if (b.attack.truth == Truth::kRegular) b.attack.margin = Rational(0);
  b.attack.argument = "rows or columns times powers of two or ten";
  return b.finish();
}

}  // namespace regulus::detail::attack
