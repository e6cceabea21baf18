// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions that must be refused, wherever they stand.
#include <chrono>

#include "codegen/model/exact/expression_parser.hpp"
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;

/// The entry stands in line 8.
const std::string kModelOfEntry =
    "regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\ny = \"1\"\n[matrix]\nrows = [[\n'''ENTRY''']]\n"
    "[motion.m]\nx = 1\ny = 1\n";

void expect_refused_entry(const std::string& entry, const std::string& found,
                          const std::string& expected) {
  expect_refused(changed(kModelOfEntry, "ENTRY", entry), 8, found, expected);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

const test::RefusedChange kRefusedEntrys[] = {
    {"Empty", "ENTRY", "", 8, "the end (character 1", "a number"},
    {"MissingOperand", "ENTRY", "x + ", 8, "the end (character 5 of 'x + ')",
     "a number, a name or '('"},
    {"MissingOperator", "ENTRY", "2 x", 8, "'x' (character 3 of '2 x')", "an operator or the end"},
    {"NumberGluedToAName", "ENTRY", "0x10", 8, "'x10' (character 2", "an operator or the end"},
    {"TwoPoints", "ENTRY", "1.2.3", 8, "'.3' (character 4", "an operator or the end"},
    {"UnclosedBracket", "ENTRY", "2*(x + 1", 8, "the end (character 9",
     "')' for the '(' at character 3"},
    {"ClosedButNotOpened", "ENTRY", "x)", 8, "')' (character 2", "an operator or the end"},
    {"FunctionWithoutBrackets", "ENTRY", "sin x", 8, "'x' (character 5",
     "'(' after the function sin"},
    {"FunctionOfNothing", "ENTRY", "sin()", 8, "')' (character 5", "a number, a name or '('"},
    {"TooManyArguments", "ENTRY", "sin(x, y)", 8, "sin with 2 arguments", "one argument"},
    {"TooFewArguments", "ENTRY", "atan2(x)", 8, "atan2 with 1 arguments", "two arguments"},
    {"UnknownFunction", "ENTRY", "system(x)", 8, "undeclared name 'system'",
     "the declared names are: "},
    {"NameUsedAsAFunction", "ENTRY", "x(1)", 8, "'(' (character 2", "an operator or the end"},
    {"Statement", "ENTRY", "x; system(0)", 8, "';' (character 2", "an operator or the end"},
    {"QuoteAndComment", "ENTRY", "x\"); }//", 8, "'\"' (character 2", "an operator or the end"},
    {"Preprocessor", "ENTRY", "#include <x>", 8, "'#' (character 1", "a number, a name or '('"},
    {"BlockComment", "ENTRY", "x /* y */", 8, "'*' (character 4", "a number, a name or '('"},
    {"Assignment", "ENTRY", "x = 1", 8, "'=' (character 3", "an operator or the end"},
    {"Power_Of_Another_Language", "ENTRY", "x**2", 8, "'*' (character 3",
     "a number, a name or '('"},
    {"OtherLetters", "ENTRY", "\u03c0*x", 8, "'\\xcf' (character 1", "a number, a name or '('"},
    {"MinusSignOfTypography", "ENTRY", "x \u2212 1", 8, "'\\xe2' (character 3",
     "an operator or the end"},
    {"DivisionOfConstantsByZero", "ENTRY", "1/0", 8, "a division by zero",
     "a divisor that is not zero"},
    {"ZeroByZero", "ENTRY", "x*(0/0)", 8, "a division by zero", "a divisor that is not zero"},
    {"DivisionByWhatIsZeroEverywhere", "ENTRY", "1/(x - x)", 8, "a division by zero",
     "a divisor that is not zero"},
    {"NegativePowerOfZero", "ENTRY", "0^-1", 8, "a division by zero", "a divisor that is not zero"},
    {"ZeroToTheZero", "ENTRY", "0^0", 8, "a division by zero", "a divisor that is not zero"},
    {"RootOfANegativeNumber", "ENTRY", "sqrt(-1)", 8, "the root of a negative number (-1)", "≥ 0"},
    {"RootOfANegativeIrrational", "ENTRY", "sqrt(3 - pi)", 8,
     "the root of a negative number (-0.14159265359)", "≥ 0"},
    {"FractionalPowerOfANegativeNumber", "ENTRY", "(-8)^(1/3)", 8,
     "fractional power of a number (-8)", "> 0"},
    {"LogarithmOfZero", "ENTRY", "log(0)", 8, "logarithm or fractional power of a number (0)",
     "> 0"},
    {"ArcSineBeyondOne", "ENTRY", "asin(2)", 8, "the arc sine or cosine of a number (2)",
     "between -1 and 1"},
    {"ArcCosineBeyondMinusOne", "ENTRY", "acos(-pi)", 8, "the arc sine or cosine",
     "between -1 and 1"},
    {"PoleOfTangent", "ENTRY", "tan(pi/2)", 8, "an operation that has no value",
     "an operation that is defined"},
    {"ArcTangentOfTheOrigin", "ENTRY", "atan2(0, 0)", 8, "atan2(0, x) with x ≤ 0",
     "y ≠ 0 or x > 0"},
    {"VariableExponent", "ENTRY", "2^x", 8, "an exponent that is not a rational constant",
     "an integer or a fraction"},
    {"ExponentThatOnlySimplifiesToAConstant", "ENTRY", "x^(1 + y - y)", 8,
     "an exponent that is not a rational constant", "an integer or a fraction"},
    {"IrrationalExponent", "ENTRY", "x^pi", 8, "an exponent that is not a rational constant",
     "an integer"},
    {"HugeExponent", "ENTRY", "x^1000000", 8, "an exponent beyond ±100", "a smaller exponent"},
    {"HugeNegativeExponent", "ENTRY", "x^-1e300", 8, "an exponent beyond ±100",
     "a smaller exponent"},
    {"HugeDecimalExponent", "ENTRY", "1e999999999", 8, "'1e999999999'", "an exponent within ±1000"},
    {"DecimalExponentBeyondAnyInteger", "ENTRY", "1e-99999999999999999999", 8,
     "'1e-99999999999999999999'", "an exponent within ±1000"},
    {"NumberOfTooManyDigits", "ENTRY", std::string(1001, '7'), 8, "'7777", "at most 1000 digits"},
    {"TowerOfPowersOfNumbers", "ENTRY", "(((10^100)^100)^100)^100", 8, "numbers too large", "bits"},
    {"TenThousandBrackets", "ENTRY", repeated("(", 10000) + "x" + repeated(")", 10000), 8,
     "an expression nested too deeply", "at most 256 levels"},
    {"TenThousandMinusSigns", "ENTRY", repeated("-", 10000) + "x", 8,
     "an expression nested too deeply", "at most 256 levels"},
    {"TenThousandCarets", "ENTRY", repeated("x^", 10000) + "1", 8,
     "an expression nested too deeply", "at most 256 levels"},
};

class RefusedEntry : public testing::TestWithParam<test::RefusedChange> {};
TEST_P(RefusedEntry, IsToldWithItsLine) { expect_refused(GetParam(), kModelOfEntry); }
INSTANTIATE_TEST_SUITE_P(Each, RefusedEntry, testing::ValuesIn(kRefusedEntrys),
                         test::name_of_change);

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
}  // namespace regulus::detail
