// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/families/builder.hpp"

#include <algorithm>

#include "tests/attack/families/hidden.hpp"

namespace regulus::detail::attack {
Builder::Builder(const char* family, std::uint64_t seed) : random(family, seed) {
  attack.family = family;
  attack.seed = seed;
}

Rational Builder::number() {
  const Rational sign = random.one_in(2) ? 1 : -1;
  return sign * positive();
}

Rational Builder::positive() {
  const auto decimal = [this](long most_digits) {
    const long count = random.between(1, most_digits);
    std::string digits(1, static_cast<char>('1' + random.below(9)));
    while (static_cast<long>(digits.size()) < count)
      digits += static_cast<char>('0' + random.below(10));
    return Rational::decimal(digits, random.between(0, 1) - count);
  };
  switch (random.below(5)) {
    case 0:
      return Rational(random.between(1, 12));
    case 1:
      return Rational(random.between(1, 20), static_cast<unsigned long>(random.between(1, 12)));
    case 2:
      return Rational(random.between(1, 1 << 20)) * Rational::two_to(-random.between(10, 24));
    case 3:
      return decimal(17);
    default:
      return decimal(60);
  }
}

Rational Builder::margin(long most) {
  switch (random.below(4)) {
    case 0:
      return Rational::ten_to(-random.between(6, 16));
    case 1:
      return Rational::ten_to(-random.between(15, 25));
    default:
      return Rational(random.between(1, 9)) * Rational::ten_to(-random.between(6, most));
  }
}

Rational Builder::excess(long most) {
  const Rational m = margin(most);
  return Rational(random.between(-1, 1)) * m;
}

void Builder::range(const std::string& name, const Rational& lo, const Rational& hi) {
  names_.push_back(name);
  attack.axes.push_back({name, lo, hi});
  if (random.one_in(8)) {
    // The file has another range; the range of the option counts.
    attack.model.pose.push_back({name, "[0, 1]", ""});
    attack.options.insert(attack.options.end(), {"--range", name + "=" + spell_option(lo, random) +
                                                                ":" + spell_option(hi, random)});
    return;
  }
  attack.model.pose.push_back(
      {name, "[" + spell_toml(lo, random) + ", " + spell_toml(hi, random) + "]", ""});
}

void Builder::range_around(const std::string& name, const Rational& p) {
  const auto width = [this] {
    return Rational(random.between(1, 30)) *
           Rational::ten_to(random.one_in(4) ? -random.between(2, 12) : -1);
  };
  const Rational below = width(), above = width();
  range(name, p - below, p + above);
}

void Builder::value(const std::string& name, const Rational& p) {
  names_.push_back(name);
  attack.model.pose.push_back({name, spell_toml(p, random), text(p)});
}

void Builder::range_of(const std::string& name, const std::string& from, const std::string& to,
                       const Rational& lo, const Rational& hi) {
  names_.push_back(name);
  attack.axes.push_back({name, lo, hi});
  attack.model.pose.push_back({name, "[" + quoted(from) + ", " + quoted(to) + "]", ""});
}

void Builder::follow(const std::vector<std::vector<Rational>>& points) {
  std::string& way = attack.model.way;
  const bool has_times = coin();
  way = has_times ? "t" : "";
  for (const PoseEntry& entry : attack.model.pose) way += (way.empty() ? "" : ",") + entry.name;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string line = has_times ? std::to_string(i) : "";
    for (const Rational& value : points[i]) {
      const Decimal d = decimal_of(value).value();
      line += (line.empty() ? "" : ",") + std::string(d.negative ? "-" : "") + d.digits +
              (d.exponent == 0 ? "" : "e" + std::to_string(d.exponent));
    }
    way += '\n' + line;
  }
  way += '\n';
}

void Builder::error(const std::string& name, const Rational& size) {
  attack.model.error.push_back({name, spell_toml(size, random)});
  attack.axes.push_back({name + "_error", -size, size});
}

void Builder::uncertain(const std::string& name, const Rational& v, const Rational& t) {
  attack.axes.push_back({name, v - t, v + t});
  std::string line = "{ value = " + spell_toml(v, random) + ", tolerance = ";
  if (random.one_in(5)) {
    const std::string group = "g" + name;
    attack.options.insert(attack.options.end(),
                          {"--tolerance", group + "=" + spell_option(t, random)});
    line += "0, group = " + quoted(group);
  } else {
    line += spell_toml(t, random);
  }
  attack.model.geometry.push_back({name, line + " }"});
  names_.push_back(name);
}

void Builder::hide(const std::string& factor, bool plain) {
  std::vector<std::string> factors{factor};
  constant_ = Rational(1);
  const std::size_t order = 1 + random.below(4);
  while (factors.size() < order) {
    const Rational c = plain || coin() ? Rational(1) : number();
    constant_ *= c.magnitude();
    factors.push_back(text(c));
  }
  hide_all(std::move(factors));
}

void Builder::hide_all(std::vector<std::string> factors) {
  attack.model.rows = hidden_product(std::move(factors), names_, random);
}

void Builder::singular(Planted at, bool decidable) {
  attack.truth = Truth::kSingular;
  attack.planted = std::move(at);
  attack.decidable = decidable;
}

void Builder::regular(const Rational& lower, bool decidable) {
  attack.truth = Truth::kRegular;
  attack.margin = lower * constant_;
  attack.decidable = decidable;
}

void Builder::undefined(Planted at, bool or_singular) {
  attack.truth = or_singular ? Truth::kUndefinedOrSingular : Truth::kUndefined;
  attack.planted = std::move(at);
  attack.may_be_refused = true;
}

void Builder::decide(const Rational& excess, const Planted& at) {
  if (excess.sign() > 0)
    regular(excess);
  else
    singular(at);
  attack.planted = at;
}

Attack Builder::finish() { return std::move(attack); }

}  // namespace regulus::detail::attack
