// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/expression_parser.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "codegen/support/errors.hpp"

namespace regulus::detail::expression_parser_test {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::Pi;

class TwoNames final : public Names {
 public:
  const ParsedExpression* find(const std::string& name, int) override {
    const auto at = terms_.find(name);
    return at == terms_.end() ? nullptr : &at->second;
  }
  std::vector<std::string> all() const override { return {"x", "y"}; }

 private:
  std::map<std::string, ParsedExpression> terms_ = {{"x", variable(x)}, {"y", variable(y)}};

 public:
  inline static const GiNaC::realsymbol x{"x"}, y{"y"};
};

const GiNaC::realsymbol& x = TwoNames::x;
const GiNaC::realsymbol& y = TwoNames::y;

ParsedExpression parse(const std::string& text) {
  TwoNames names;
  return parse_expression(text, names, {.file = "test", .line = 1});
}

ex half_power(const ex& e) { return GiNaC::pow(e, numeric(1, 2)); }

/// Checks that exactly these expressions must be defined, in this order.
void expect_conditions(const std::string& text, const std::vector<ex>& expected) {
  const ParsedExpression term = parse(text);
  ASSERT_EQ(term.must_be_defined.size(), expected.size()) << text;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(term.must_be_defined[i].is_equal(expected[i]))
        << text << " gave " << term.must_be_defined[i] << ", not " << expected[i];
}

void expect_value(const std::string& text, const ex& expected) {
  const ex value = parse(text).value;
  EXPECT_TRUE(value.is_equal(expected)) << text << " gave " << value << ", not " << expected;
}

TEST(ExpressionParser, KnowsPrecedence) {
  expect_value("1 + 2*3", 7);
  expect_value("2*3^2", 18);
  expect_value("(1 + 2)*3", 9);
  expect_value("-2^2", -4);
  expect_value("(-2)^2", 4);
  expect_value("2*-3", -6);
  expect_value("2^-1", numeric(1, 2));
  expect_value("- - 2", 2);
  expect_value("+x", x);
}

TEST(ExpressionParser, KnowsAssociativity) {
  expect_value("10 - 4 - 3", 3);
  expect_value("16/4/2", 2);
  expect_value("16/4*2", 8);
  expect_value("2^3^2", 512);
  expect_value("x - y - x", -y);
}

TEST(ExpressionParser, IgnoresWhiteSpace) { expect_value(" \t x\n+\r 1 ", x + 1); }

TEST(ExpressionParser, KeepsNumbersExact) {
  expect_value("0.1 + 0.2 - 0.3", 0);
  expect_value("1/3 + 1/6", numeric(1, 2));
  expect_value("1e3", 1000);
  expect_value("2.5e-1*x", x / 4);
}

TEST(ExpressionParser, ReadsAnEAsAnExponentOnlyBeforeDigits) {
  TwoNames names;
  EXPECT_THROW((void)parse("2e"), InputError);
  EXPECT_THROW((void)parse("2e+x"), InputError);
  expect_value("2e1", 20);
}

TEST(ExpressionParser, KnowsPiAndDegrees) {
  expect_value("pi", Pi);
  expect_value("180*deg", Pi);
  expect_value("cos(60*deg)", numeric(1, 2));
}

TEST(ExpressionParser, KeepsConstantFunctionsSymbolic) {
  expect_value("sqrt(2)", half_power(2));
  expect_value("sqrt(8)^2", 8);
  expect_value("sqrt(9/4)", numeric(3, 2));
  expect_value("cos(pi/6)", half_power(3) / 2);
  expect_value("exp(1)", GiNaC::exp(ex(1)));
  expect_value("atan2(1, -1)", 3 * Pi / 4);
  for (const char* text : {"sqrt(2)", "sqrt(8)", "2^0.5", "exp(0.1)", "sin(1)", "2^(1/3)"}) {
    const ex value = parse(text).value;
    EXPECT_FALSE(GiNaC::is_a<numeric>(value)) << text << " gave " << value;
  }
}

TEST(ExpressionParser, AppliesEveryFunction) {
  expect_value("sqrt(x)", half_power(x));
  expect_value("sin(x)", GiNaC::sin(x));
  expect_value("cos(x)", GiNaC::cos(x));
  expect_value("tan(x)", GiNaC::tan(x));
  expect_value("asin(x)", GiNaC::asin(x));
  expect_value("acos(x)", GiNaC::acos(x));
  expect_value("atan(x)", GiNaC::atan(x));
  expect_value("atan2(x, y)", GiNaC::atan2(x, y));
  expect_value("exp(x)", GiNaC::exp(x));
  expect_value("log(x)", GiNaC::log(x));
  expect_value("abs(x)", GiNaC::abs(x));
}

TEST(ExpressionParser, TakesRationalExponents) {
  expect_value("x^(1/2)", half_power(x));
  expect_value("x^0.5", half_power(x));
  expect_value("x^(3/2)", GiNaC::pow(x, numeric(3, 2)));
  expect_value("x^(1/3)", GiNaC::exp(GiNaC::log(x) / 3));
  expect_value("8^(1/3)", 2);
  expect_value("x^0", 1);
  expect_value("x^-2", GiNaC::pow(x, -2));
}

TEST(ExpressionParser, HasNoComplexConjugates) { expect_value("abs(x)^2", x * x); }

TEST(Definedness, SurvivesCancellation) {
  expect_conditions("x/x", {1 / x});
  expect_conditions("0/x", {1 / x});
  expect_conditions("1/x - 1/x", {1 / x, 1 / x});
  expect_conditions("sqrt(x)^2", {half_power(x)});
  expect_conditions("0*log(x)", {GiNaC::log(x)});
  expect_conditions("exp(log(x))", {GiNaC::log(x)});
  expect_conditions("sin(asin(x))", {GiNaC::asin(x)});
  expect_conditions("cos(acos(x))", {GiNaC::asin(x)});
  expect_conditions("0*tan(x)", {GiNaC::tan(x)});
  expect_conditions("0*atan2(x, y)", {GiNaC::atan2(x, y)});
  expect_conditions("(x/y)^0", {1 / y});
}

TEST(Definedness, SurvivesNesting) {
  expect_conditions("1/(1/x)", {1 / x});  // the outer quotient is defined where the inner one is
  expect_conditions("x/(x - y)*(x - y)", {1 / (x - y)});
  expect_conditions("sqrt(1/x)", {1 / x, GiNaC::pow(x, numeric(-1, 2))});
}

TEST(Definedness, OfPowers) {
  expect_conditions("x^-1*x", {1 / x});
  expect_conditions("x^(-1/2)*x", {1 / x, half_power(x)});
  expect_conditions("x^(1/3)*0", {GiNaC::log(x)});
  expect_conditions("x^3", {});
}

TEST(Definedness, IsNotRecordedWhereTheFormShowsIt) {
  for (const char* text : {"sqrt(x^2 + y^2)", "1/(x^2 + 1)", "1/exp(x)", "log(1 + abs(x))",
                           "sqrt(2)", "1/3", "x*y - abs(x)", "exp(x)^(1/2)", "atan2(x, 1 + y^2)"})
    expect_conditions(text, {});
}

TEST(Definedness, IsRecordedWhereTheFormOnlySuggestsIt) {
  expect_conditions("sqrt(x^3)", {half_power(GiNaC::pow(x, 3))});
  expect_conditions("1/(x^2 + y^2)", {1 / (x * x + y * y)});
  expect_conditions("1/abs(x)", {1 / GiNaC::abs(x)});
  expect_conditions("log(x^2)", {GiNaC::log(x * x)});
}

TEST(Definedness, OfConstantsNearTheEndOfADomainIsLeftToTheCertifiedEvaluation) {
  EXPECT_EQ(parse("0*log(sqrt(2) - 1.414213562373)").must_be_defined.size(), 1U);
  EXPECT_THROW((void)parse("0*log(sqrt(2) - 2)"), InputError);
}

TEST(ExpressionParser, CountsWhatIsWritten) {
  const ParsedExpression term = parse("sin(x + y)*x");
  EXPECT_FALSE(term.constant);
  EXPECT_TRUE(parse("sin(2 + pi)").constant);
  EXPECT_FALSE(parse("x - x").constant);
  EXPECT_EQ(term.depth, 4);
  EXPECT_EQ(term.size, 6);
}

TEST(ExpressionParser, TakesLinearTime) {
  std::string text = "x";
  while (text.size() + 8 < kLongestExpression) text.append("+y*x/3");
  const auto start = std::chrono::steady_clock::now();
  const ParsedExpression term = parse(text);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_FALSE(term.constant);
}

TEST(ExpressionParser, TakesAsManyDifferentTermsAsFit) {
  std::string text = "1";
  for (int i = 2; text.size() + 32 < kLongestExpression; ++i)
    text.append("+x^").append(std::to_string(i % 100)).append("/").append(std::to_string(i));
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(parse(text).constant);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(ExpressionParser, TakesTwoHundredBrackets) {
  expect_value(std::string(200, '(') + "x" + std::string(200, ')'), x);
}

TEST(ParseConstant, RefusesNames) {
  EXPECT_THROW((void)parse_constant("x", {}), InputError);
  EXPECT_TRUE(parse_constant("-5*deg", {}).value.is_equal(-Pi / 36));
}

TEST(ParseConstant, RefusesWhatNoDoubleCanBound) {
  EXPECT_THROW((void)parse_constant("1e999", {}), InputError);
  EXPECT_THROW((void)parse_constant("exp(exp(exp(9)))", {}), InputError);
}

}  // namespace
}  // namespace regulus::detail::expression_parser_test
