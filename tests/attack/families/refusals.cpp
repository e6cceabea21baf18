// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that are not models.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// A model of one range and one entry; a test replaces one of these parts.
struct Parts {
  std::string version = "1", pose = "x = \"m\"", geometry = "u = 1", let = "c = \"u + 1\"",
              rows = "[[\"x + c\"]]", scale, x = "[0, 1]", rest;

  [[nodiscard]] std::string text() const {
    return "regulus = " + version + "\nname = \"none\"\n[pose]\n" + pose + "\n[geometry]\n" +
           geometry + "\n[let]\n" + let + "\n[matrix]\nrows = " + rows + "\n" + scale +
           "\n[motion.m]\nx = " + x + "\n" + rest + "\n";
  }
};

/// Returns a range with lo > hi, where only the last of many digits differs.
std::string inverted_range(Builder& b) {
  const Rational lo = b.number();
  const Rational hi = lo - Rational::ten_to(-b.random.between(1, 60));
  return "[" + spell_toml(lo, b.random) + ", " + spell_toml(hi, b.random) + "]";
}

std::string negative(Builder& b) { return spell_toml(-b.margin(60), b.random); }

void break_something(Builder& b, Parts& parts) {
  switch (b.random.below(12)) {
    case 0:
      parts.x = inverted_range(b);
      break;
    case 1:
      parts.geometry = "u = { value = 1, tolerance = " + negative(b) + " }";
      break;
    case 2:
      parts.rest = "alpha = " + negative(b);
      break;
    case 3:
      parts.rest = "error = { x = " + negative(b) + " }";
      break;
    case 4:
      parts.x = b.random.pick({"[0, inf]", "[nan, 1]", "nan", "inf", "[0, 1, 2]", "[]", "true",
                               "[0, \"1e\"]", "[0, \"0x10\"]", "\"1/0\"", "1979-05-27", "[0, 01]",
                               "[0, 1__0]", "[0, 1.]", "[0, .5]", "[0, \"1e2000\"]", "[0, 0x]"});
      break;
    case 5:
      parts.rows = b.random.pick({"[]",
                                  "[[]]",
                                  "[[\"x\", \"1\"]]",
                                  "[[\"x\"], [\"x\", \"1\"]]",
                                  "[[\"y\"]]",
                                  "[[\"x +\"]]",
                                  "[[\"(x\"]]",
                                  "[[\"x x\"]]",
                                  "[[\"sqrt(x, 1)\"]]",
                                  "[[\"x^\"]]",
                                  "[[\"1/0\"]]",
                                  "[[\"log(0)\"]]",
                                  "[[\"sqrt(-1)\"]]",
                                  "[[\"asin(2)\"]]",
                                  "[[\"x; y\"]]",
                                  "[[\"\"]]",
                                  "[[\"1 / (1 - 1)\"]]",
                                  "[[\"foo(x)\"]]",
                                  "[[inf]]",
                                  "\"x\"",
                                  "[[\"0^(-1)\"]]",
                                  "[[\"atan2(x)\"]]"});
      break;
    case 6:
      parts.let = b.random.pick({"c = \"d\"\nd = \"c\"", "c = \"c\"", "c = \"1\"\nc = \"2\"",
                                 "x = \"1\"", "pi = \"1\"", "c = \"u +\"", "c = \"1e99999\""});
      break;
    case 7:
      parts.scale = b.random.pick({"row_scale = [0]", "row_scale = [-1]", "row_scale = []",
                                   "row_scale = [1, 1]", "row_scale = [\"-1e-300\"]"});
      break;
    case 8:
      parts.rest = b.random.pick({"y = 1", "constraint = [\"x\"]", "constraints = \"x\"",
                                  "constraints = [\"y\"]", "parameters = { T = [0, 1] }",
                                  "error = { y = 1 }", "alpha = nan", "alpha = \"x\""});
      break;
    case 9:
      parts.version = b.random.pick({"2", "0", "\"1\"", "true", "1.5"});
      break;
    case 10:
      parts.geometry = b.random.pick({"u = nan", "u = \"x\"", "u = { tolerance = 1 }",
                                      "u = { value = 1, radius = 1 }",
                                      "u = { value = [1, 2], tolerance = 1, radius = 1 }",
                                      "u = { value = 1, tolerence = 1 }", "u = []", "2u = 1"});
      break;
    default:
      parts.pose = b.random.pick({"", "x = 1", "x = \"m\"\nalpha = \"m\"", "x = \"m\"\nx = \"m\"",
                                  "x = \"m\"\ny = \"m\"", "sin = \"m\"", "x = \"m\"\nu = \"m\""});
  }
}

}  // namespace

Attack refused(std::uint64_t seed) {
  Builder b("refused", seed);
  Parts parts;
  break_something(b, parts);
  b.attack.model.instead = parts.text();
  b.attack.truth = Truth::kRefused;
  b.attack.argument = "one thing that no model may have";
  return b.finish();
}

}  // namespace regulus::detail::attack
