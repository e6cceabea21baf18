// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/from_ginac.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex, GiNaC::numeric, GiNaC::pow;

class FromGinac : public ::testing::Test {
 protected:
  std::string text(const ex& e) { return to_string(GinacReader(meaning).read(e)); }

  void expect_refused(const ex& e, const std::string& expected) {
    try {
      static_cast<void>(GinacReader(meaning).read(e));
      FAIL() << e << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }

  GiNaC::realsymbol x{"x"}, y{"y"};
  SymbolMeaning meaning{{x, variable("x")}, {y, variable("y")}};
};

TEST_F(FromGinac, RationalsStayExact) { EXPECT_EQ(text(x * numeric(1, 3)), "1/3*x"); }

TEST_F(FromGinac, HalfIntegerPowersAreRoots) {
  EXPECT_EQ(text(GiNaC::sqrt(x + y)), "sqrt(x + y)");
  EXPECT_EQ(text(pow(x + y, numeric(3, 2))), "sqrt(x + y)^3");
  EXPECT_EQ(text(pow(x + y, numeric(-1, 2))), "1/sqrt(x + y)");
}

TEST_F(FromGinac, DyadicPowersAreRootsOfRoots) {
  EXPECT_EQ(text(GiNaC::sqrt(GiNaC::sqrt(x))), "sqrt(sqrt(x))");
  EXPECT_EQ(text(pow(x + y, numeric(3, 4))), "sqrt(sqrt(x + y))^3");
  EXPECT_EQ(text(pow(x, numeric(-1, 8))), "1/sqrt(sqrt(sqrt(x)))");
  EXPECT_EQ(text(pow(ex(2), numeric(1, 4)) * x), "x*sqrt(sqrt(2))");
}

TEST_F(FromGinac, OtherPowersAreExponentials) {
  EXPECT_EQ(text(pow(x, numeric(1, 3))), "exp(1/3*log(x))");
  EXPECT_EQ(text(pow(x + y, numeric(-5, 6))), "exp(-5/6*log(x + y))");
  // No integer power has this numerator.
  const numeric huge = numeric(1) + numeric(1) / numeric(2).power(numeric(20));
  EXPECT_EQ(text(pow(x, huge)), "exp(1048577/1048576*log(x))");
}

TEST_F(FromGinac, FunctionsKeepTheirArguments) {
  EXPECT_EQ(text(GiNaC::atan2(y, x)), "atan2(y, x)");
  EXPECT_EQ(text(GiNaC::sin(GiNaC::Pi * x)), "sin(pi*x)");
  EXPECT_EQ(text(GiNaC::abs(x - y)), "abs(x - y)");
}

TEST_F(FromGinac, SignsOfPowersDoNotDependOnTermOrder) {
  EXPECT_EQ(text(pow(x - y, 3)), "(x - y)^3");
  EXPECT_EQ(text(pow(y - x, 3)), "-(x - y)^3");
  EXPECT_EQ(text(pow(y - x, -2)), "1/(x - y)^2");
  EXPECT_EQ(text(pow(6 * y - 4 * x, 2)), "4*(2*x - 3*y)^2");
}

TEST_F(FromGinac, SignsOfPowersDoNotDependOnWhatVanishes) {
  // GiNaC makes (x - y)^2 or (y - x)^2 of it, and then y stands for 0.
  meaning[y] = Expression(0);
  EXPECT_EQ(text(pow(x - y, 2)), "x^2");
  meaning[x] = -variable("x");
  EXPECT_EQ(text(pow(x, 2)), "x^2");
  EXPECT_EQ(text(pow(x, -3)), "-1/x^3");
  EXPECT_EQ(text(1 / (x - y)), "-1/x");
}

TEST_F(FromGinac, SumsInThePlaceOfSymbolsAreTermsOfTheSum) {
  const ex nested = (numeric(20) - x).subs(x == x + y, GiNaC::subs_options::no_pattern);
  EXPECT_EQ(text(nested), text(20 - x - y));
  EXPECT_EQ(text((3 - 2 * x).subs(x == x - y)), text(3 - 2 * x + 2 * y));
  EXPECT_EQ(text(1 + x * (x + y)), "x*(x + y) + 1") << "a product of its own";
}

TEST_F(FromGinac, RefusesWhatIsNotExact) {
  expect_refused(x * numeric(0.5), "exact rational");
  expect_refused(x * GiNaC::I, "exact rational");
  expect_refused(x + GiNaC::Catalan, "arithmetic expression");
  expect_refused(pow(x, y), "rational exponent");
  expect_refused(pow(x, numeric(0.5)), "rational exponent");
  expect_refused(pow(x, numeric("10000000000")), "moderate size");
  expect_refused(GiNaC::step(x), "functions sqrt sin");
  expect_refused(x + GiNaC::realsymbol("stranger"), "pose, geometry or motion");
}

}  // namespace
}  // namespace regulus::detail
