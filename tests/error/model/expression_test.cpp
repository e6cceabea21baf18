// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions that must be refused, wherever they stand.
#include <chrono>

#include "codegen/model/exact/expression_parser.hpp"
#include "tests/error/model/refusal.hpp"

namespace regulus {
namespace {

using test::expect_refused;

/// Expects that a model with this matrix entry is refused.
void expect_refused_entry(const std::string& entry, const std::string& found,
                          const std::string& expected) {
  expect_refused(
      "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\ny = \"1\"\n[matrix]\nrows = [[\n'''" + entry +
          "''']]\n[motion.m]\nx = 1\ny = 1\n",
      8, found, expected);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(ExpressionRefusal, Empty) { expect_refused_entry("", "the end (character 1", "a number"); }

TEST(ExpressionRefusal, MissingOperand) {
  expect_refused_entry("x + ", "the end (character 5 of 'x + ')", "a number, a name or '('");
}

TEST(ExpressionRefusal, MissingOperator) {
  expect_refused_entry("2 x", "'x' (character 3 of '2 x')", "an operator or the end");
}

TEST(ExpressionRefusal, NumberGluedToAName) {
  expect_refused_entry("0x10", "'x10' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, TwoPoints) {
  expect_refused_entry("1.2.3", "'.3' (character 4", "an operator or the end");
}

TEST(ExpressionRefusal, UnclosedBracket) {
  expect_refused_entry("2*(x + 1", "the end (character 9", "')' for the '(' at character 3");
}

TEST(ExpressionRefusal, ClosedButNotOpened) {
  expect_refused_entry("x)", "')' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, FunctionWithoutBrackets) {
  expect_refused_entry("sin x", "'x' (character 5", "'(' after the function sin");
}

TEST(ExpressionRefusal, FunctionOfNothing) {
  expect_refused_entry("sin()", "')' (character 5", "a number, a name or '('");
}

TEST(ExpressionRefusal, TooManyArguments) {
  expect_refused_entry("sin(x, y)", "sin with 2 arguments", "one argument");
}

TEST(ExpressionRefusal, TooFewArguments) {
  expect_refused_entry("atan2(x)", "atan2 with 1 arguments", "two arguments");
}

TEST(ExpressionRefusal, UnknownFunction) {
  expect_refused_entry("system(x)", "undeclared name 'system'", "the declared names are: ");
}

TEST(ExpressionRefusal, NameUsedAsAFunction) {
  expect_refused_entry("x(1)", "'(' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, Statement) {
  expect_refused_entry("x; system(0)", "';' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, QuoteAndComment) {
  expect_refused_entry("x\"); }//", "'\"' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, Preprocessor) {
  expect_refused_entry("#include <x>", "'#' (character 1", "a number, a name or '('");
}

TEST(ExpressionRefusal, BlockComment) {
  expect_refused_entry("x /* y */", "'*' (character 4", "a number, a name or '('");
}

TEST(ExpressionRefusal, Assignment) {
  expect_refused_entry("x = 1", "'=' (character 3", "an operator or the end");
}

TEST(ExpressionRefusal, Power_Of_Another_Language) {
  expect_refused_entry("x**2", "'*' (character 3", "a number, a name or '('");
}

TEST(ExpressionRefusal, OtherLetters) {
  expect_refused_entry("\u03c0*x", "'\\xcf' (character 1", "a number, a name or '('");
}

TEST(ExpressionRefusal, MinusSignOfTypography) {
  expect_refused_entry("x \u2212 1", "'\\xe2' (character 3", "an operator or the end");
}

TEST(ExpressionRefusal, ControlCharacter) {
  expect_refused(
      "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[\"x\\u0007\"]]\n", 6,
      "'\\x07' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, NulCharacter) {
  expect_refused(
      "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[\"x\\u0000 y\"]]\n", 6,
      "'\\x00' (character 2", "an operator or the end");
}

TEST(ExpressionRefusal, DivisionOfConstantsByZero) {
  expect_refused_entry("1/0", "a division by zero", "a divisor that is not zero");
}

TEST(ExpressionRefusal, ZeroByZero) {
  expect_refused_entry("x*(0/0)", "a division by zero", "a divisor that is not zero");
}

TEST(ExpressionRefusal, DivisionByWhatIsZeroEverywhere) {
  expect_refused_entry("1/(x - x)", "a division by zero", "a divisor that is not zero");
}

TEST(ExpressionRefusal, NegativePowerOfZero) {
  expect_refused_entry("0^-1", "a division by zero", "a divisor that is not zero");
}

TEST(ExpressionRefusal, ZeroToTheZero) {
  expect_refused_entry("0^0", "a division by zero", "a divisor that is not zero");
}

TEST(ExpressionRefusal, RootOfANegativeNumber) {
  expect_refused_entry("sqrt(-1)", "the root of a negative number (-1.000000)", "≥ 0");
}

TEST(ExpressionRefusal, RootOfANegativeIrrational) {
  expect_refused_entry("sqrt(3 - pi)", "the root of a negative number (-0.141593)", "≥ 0");
}

TEST(ExpressionRefusal, FractionalPowerOfANegativeNumber) {
  expect_refused_entry("(-8)^(1/3)", "fractional power of a number (-8.000000)", "> 0");
}

TEST(ExpressionRefusal, LogarithmOfZero) {
  expect_refused_entry("log(0)", "logarithm or fractional power of a number (0.000000)", "> 0");
}

TEST(ExpressionRefusal, ArcSineBeyondOne) {
  expect_refused_entry("asin(2)", "the arc sine or cosine of a number (2.000000)",
                       "between -1 and 1");
}

TEST(ExpressionRefusal, ArcCosineBeyondMinusOne) {
  expect_refused_entry("acos(-pi)", "the arc sine or cosine", "between -1 and 1");
}

TEST(ExpressionRefusal, PoleOfTangent) {
  expect_refused_entry("tan(pi/2)", "an operation that has no value",
                       "an operation that is defined");
}

TEST(ExpressionRefusal, ArcTangentOfTheOrigin) {
  expect_refused_entry("atan2(0, 0)", "atan2(0, x) with x ≤ 0", "y ≠ 0 or x > 0");
}

TEST(ExpressionRefusal, VariableExponent) {
  expect_refused_entry("2^x", "an exponent that is not a rational constant",
                       "an integer or a fraction");
}

TEST(ExpressionRefusal, ExponentThatOnlySimplifiesToAConstant) {
  expect_refused_entry("x^(1 + y - y)", "an exponent that is not a rational constant",
                       "an integer or a fraction");
}

TEST(ExpressionRefusal, IrrationalExponent) {
  expect_refused_entry("x^pi", "an exponent that is not a rational constant", "an integer");
}

TEST(ExpressionRefusal, HugeExponent) {
  expect_refused_entry("x^1000000", "an exponent beyond ±100", "a smaller exponent");
}

TEST(ExpressionRefusal, HugeNegativeExponent) {
  expect_refused_entry("x^-1e300", "an exponent beyond ±100", "a smaller exponent");
}

TEST(ExpressionRefusal, HugeDecimalExponent) {
  expect_refused_entry("1e999999999", "'1e999999999'", "an exponent within ±1000");
}

TEST(ExpressionRefusal, DecimalExponentBeyondAnyInteger) {
  expect_refused_entry("1e-99999999999999999999", "'1e-99999999999999999999'",
                       "an exponent within ±1000");
}

TEST(ExpressionRefusal, NumberOfTooManyDigits) {
  expect_refused_entry(std::string(1001, '7'), "'7777", "at most 1000 digits");
}

TEST(ExpressionRefusal, TowerOfPowersOfNumbers) {
  expect_refused_entry("(((10^100)^100)^100)^100", "numbers too large", "bits");
}

TEST(ExpressionRefusal, TenThousandBrackets) {
  expect_refused_entry(repeated("(", 10000) + "x" + repeated(")", 10000),
                       "an expression nested too deeply", "at most 256 levels");
}

TEST(ExpressionRefusal, TenThousandMinusSigns) {
  expect_refused_entry(repeated("-", 10000) + "x", "an expression nested too deeply",
                       "at most 256 levels");
}

TEST(ExpressionRefusal, TenThousandCarets) {
  expect_refused_entry(repeated("x^", 10000) + "1", "an expression nested too deeply",
                       "at most 256 levels");
}

TEST(ExpressionRefusal, MegabyteIsRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  expect_refused_entry(repeated("x+", 500000) + "x", "an expression of 1000001 bytes",
                       "at most 65536");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

std::string link(int index) { return std::string(1, 'v').append(std::to_string(index)); }

/// Returns a chain of sub-expressions; each uses the one before it in the given way.
std::string chain(int links, const std::string& first, const std::string& before,
                  const std::string& after) {
  std::string text =
      "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[let]\nv0 = \"" + first + "\"\n";
  for (int i = 1; i <= links; ++i)
    text.append(link(i))
        .append(" = \"")
        .append(before)
        .append(link(i - 1))
        .append(after)
        .append(link(i - 1))
        .append(")\"\n");
  text.append("[matrix]\nrows = [[\"").append(link(links)).append("\"]]\n[motion.m]\nx = 1\n");
  return text;
}

TEST(ExpressionRefusal, DoublingChainOfSubExpressions) {
  expect_refused(chain(60, "x", "sin(", ")*cos("), 21, "an expression too large",
                 "at most 100000 operations");
}

TEST(ExpressionRefusal, SquaringChainOfCoefficients) {
  expect_refused(chain(60, "10^100*x", "(", ")*("), 17, "numbers too large", "bits");
}

TEST(ExpressionRefusal, ChainDeeperThanTheStackShouldGo) {
  std::string text = "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[let]\n";
  for (int i = 0; i < 20000; ++i)
    text.append(link(i)).append(" = \"sin(").append(link(i + 1)).append(")\"\n");
  text += "v20000 = \"x\"\n[matrix]\nrows = [[\"v0\"]]\n[motion.m]\nx = 1\n";
  try {
    (void)parse_model(text, "m.toml");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("nested too deeply"));
  }
}

}  // namespace
}  // namespace regulus
