// SPDX-License-Identifier: GPL-3.0-or-later
// Poses at which an expression has no value, or is close to having none.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// Replaces each # of a pattern by the text.
std::string with(const std::string& pattern, const std::string& text) {
  std::string result;
  for (const char c : pattern) c == '#' ? result += text : result += c;
  return result;
}

/// Adds x over `width`: from `end` if `lower`, else up to `end`.
void range_from(Builder& b, const Rational& end, const Rational& width, bool lower) {
  b.range("x", lower ? end : end - width, lower ? end + width : end);
}

}  // namespace

Attack pole(std::uint64_t seed) {
  Builder b("pole", seed);
  const Rational p = b.number(), q = b.number();
  const std::string dx = minus("x", b.text(p)), dy = minus("y", b.text(q));
  b.attack.argument = "a quotient that has no root";
  if (b.random.one_in(3)) {
    const Rational m = b.margin(60), width(b.random.between(1, 30), 10);
    const bool lower = b.coin();
    range_from(b, lower ? p + m : p - m, width, lower);
    b.hide(with(b.random.pick({"1/#", "1/#^2", "3 + 1/#^2"}), dx));
    b.regular((Rational(1) / ((width + m) * (width + m) + width + m)));
    return b.finish();
  }
  b.range_around("x", p);
  b.range_around("y", q);
  const Planted at{{"x", b.text(p)}, {"y", b.text(q)}};
  b.hide(b.random.one_in(3)
             ? "1/(" + dx + "^2 + " + dy + "^2)"
             : with(b.random.pick({"1/#", "1/#^2", "1/#^3", "2 + 1/#^2", "exp(1/#)", "1/abs#",
                                   "1/sin#", "1/(exp# - 1)", "1 + 1/log(1 + #^2)"}),
                    dx));
  b.undefined(at);
  return b.finish();
}

Attack removable(std::uint64_t seed) {
  Builder b("removable", seed);
  const Rational p = b.number();
  const std::string d = minus("x", b.text(p));
  b.range_around("x", p);
  b.hide(with(b.random.pick({"#/#", "sin#/#", "(exp# - 1)/#", "#*(1/#)", "1 + 0/#", "1 + # - #/#*#",
                             "3 + 1/# - 1/#", "1/(1/#) + 7 - #", "2 + #^2/#^2", "1 + 0*log#",
                             "exp(log(#^2) - log(#^2))", "abs#/abs#", "(#^3 + #)/#", "1 + #*0/#",
                             "exp#*(1/#)*#", "atan#/#", "1 + 0*atan2(0, -#^2)"}),
              d));
  b.undefined({{"x", b.text(p)}});
  b.attack.argument = "an operand that has no value at the point";
  return b.finish();
}

Attack branch_cut(std::uint64_t seed) {
  Builder b("branch", seed);
  const Rational m = b.margin(), p = b.number(), one(1), width(b.random.between(1, 9), 20);
  const std::string d = minus("x", b.text(p));
  switch (b.random.below(16)) {
    case 0:
      b.range("x", -one, one + m);
      b.hide("asin(x) + 2");
      b.undefined({{"x", b.text(one + m)}});
      break;
    case 1:
      b.range("x", -one, one);
      b.hide("asin(x) + 2");
      b.regular(Rational(4, 10));
      break;
    case 2:
      b.range("x", -one - m, one);
      b.hide("acos(x) + 1");
      b.undefined({{"x", b.text(-one - m)}});
      break;
    case 3:
      b.range("x", 0, one);
      b.hide("acos(x)");
      b.singular({{"x", "1"}});
      break;
    case 4:
      b.range("x", 0, one - m);
      b.hide("acos(x)");
      b.regular(m);  // acos(1 − m) ≥ √(2m)
      break;
    case 5:
      b.range("x", p, p + width);
      b.hide("sqrt" + d);
      b.singular({{"x", b.text(p)}});
      break;
    case 6:
      b.range("x", p - m, p + width);
      b.hide("1 + sqrt" + d);
      b.undefined({{"x", b.text(p - m)}});
      break;
    case 7:
      b.range("x", p + m, p + width);
      b.hide("sqrt" + d);
      b.regular(m);
      break;
    case 8:
      b.range("x", p, p + width);
      b.hide("log" + d);
      b.undefined({{"x", b.text(p)}});
      break;
    case 9:
      b.range("x", p + m, p + width);
      b.hide("log" + d);
      b.regular(Rational(1, 2));  // width ≤ 9/20
      break;
    case 10:
      b.range("x", p + width, p + one);
      b.hide("log" + d);
      b.singular({{"x", b.text(p + one)}});
      break;
    case 11:
      b.range("x", Rational(-2), -one);
      b.range("y", -one, one);
      // The matrix has either limit on the cut. One of the first two is 0.
      if (b.coin()) {
        b.hide(b.random.pick({"atan2(y, x) - pi", "atan2(y, x) + pi"}));
        b.undefined({{"x", "-3/2"}, {"y", "0"}});
      } else {
        b.hide(b.random.pick({"atan2(y, x)", "atan2(y, x) - 4", "atan2(y, x) + 0.5"}));
        b.regular(Rational(8, 10));  // |atan2(y, x)| is between 3π/4 and π
      }
      break;
    case 12:
      b.range("x", Rational(-2), -one);
      b.range("y", m, one);
      b.hide("atan2(y, x)");
      b.regular(Rational(3, 2));
      break;
    case 13:
      b.range("x", 0, one);
      b.range("y", 0, one);
      b.hide("1 + atan2(y, x)");
      b.undefined({{"x", "0"}, {"y", "0"}});
      break;
    case 14:
      b.range("x", 0, one);
      b.hide("asin(x) - pi/2");
      b.singular({{"x", "1"}});
      break;
    default:
      b.range_of("x", "-pi/4", "pi/2" + (b.coin() ? std::string() : " - " + b.text(m)),
                 Rational(-3, 4), Rational(3, 2));
      if (b.attack.model.pose.front().toml.find("pi/2\"") != std::string::npos) {
        b.hide("cos(x)");
        b.singular({{"x", "pi/2"}});
      } else {
        b.hide("cos(x)");
        b.regular(0);  // cos(π/2 − m) = sin m > 0
      }
  }
  b.attack.argument = "the domain of an elementary function";
  return b.finish();
}

Attack sign_jump(std::uint64_t seed) {
  Builder b("jump", seed);
  const Rational p = b.number();
  std::string d = minus("x", b.text(p));
  Planted at{{"x", b.text(p)}};
  b.range_around("x", p);
  if (b.random.one_in(3)) {
    b.range_around("y", p);
    d = "(x - y)";
    at["y"] = at["x"];
  }
  if (b.random.one_in(6)) {
    b = Builder("jump", seed);
    b.range("x", 1, 2);
    b.hide("tan(x)");
    b.undefined({{"x", "pi/2"}});
  } else {
    b.hide(with(
        b.random.pick({"abs#/#", "#/abs#", "1/#", "1/#^3", "#/sqrt(#^2)", "atan(1/#)",
                       "2 + 5*abs#/#", "1/(2*#)", "abs#/# - 0.25", "#^3/abs#^3", "atan2(#, 0)"}),
        d));
    b.undefined(at);
  }
  b.attack.argument = "the factor jumps over 0 and never takes it";
  return b.finish();
}

Attack rational_exponent(std::uint64_t seed) {
  Builder b("power", seed);
  const long degree = b.random.between(2, 9), times = b.random.between(1, 7);
  const Rational r = b.coin() ? Rational(b.random.between(1, 9), 4) : b.positive();
  const Rational x = r.to_the(degree);
  const std::string exponent = "(" + std::to_string(times) + "/" + std::to_string(degree) + ")";
  const Rational m = b.margin(30);
  switch (b.random.below(6)) {
    case 0:
      b.range("x", x * Rational(1, 2), x * Rational(2));
      b.hide("x^" + exponent + " - " + b.text(r.to_the(times)));
      b.singular({{"x", b.text(x)}}, true);
      break;
    case 1:
      b.range("x", x + m, x + Rational(1));
      b.hide("x^" + exponent + " - " + b.text(r.to_the(times)));
      b.regular(0);
      break;
    case 2:
      b.range("x", -m, 1);
      b.hide("1 + x^(1/" + std::to_string(2 * times) + ")");
      b.undefined({{"x", b.text(-m)}});
      break;
    case 3:
      b.range("x", 0, 1);
      b.hide("x^" + exponent);
      b.undefined({{"x", "0"}}, true);
      break;
    case 4:
      b.range("x", r.to_the(4) * Rational(1, 2), r.to_the(4) * Rational(3));
      b.hide("sqrt(sqrt(x)) - " + b.text(r));
      b.singular({{"x", b.text(r.to_the(4))}}, true);
      break;
    default:
      b.range("x", m, 1);
      b.hide("x^(-" + exponent + ")");
      b.regular(1);
  }
  b.attack.argument = "a perfect power";
  return b.finish();
}

}  // namespace regulus::detail::attack
