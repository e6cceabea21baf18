// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <type_traits>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::formula {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

class KnownSymbols final : public Names {
 public:
  explicit KnownSymbols(const std::vector<GiNaC::realsymbol>& symbols) {
    for (const GiNaC::realsymbol& s : symbols) terms_.emplace(s.get_name(), variable(s));
  }
  const ParsedExpression* find(const std::string& name, int) override {
    const auto at = terms_.find(name);
    return at == terms_.end() ? nullptr : &at->second;
  }
  std::vector<std::string> all() const override { return {}; }

 private:
  std::map<std::string, ParsedExpression> terms_;
};

const Formula x("x"), y("y");

TEST(Formula, ReadsLikeTheExpressionThatWasWritten) {
  EXPECT_EQ((x - (y - 1)).text(), "x - (y - 1)");
  EXPECT_EQ((x - y - 1).text(), "x - y - 1");
  EXPECT_EQ((x / (y * 2)).text(), "x/(y*2)");
  EXPECT_EQ((x * y / 2).text(), "x*y/2");
  EXPECT_EQ((-x * y).text(), "(-x)*y");
  EXPECT_EQ((-(x * y)).text(), "-x*y");
  EXPECT_EQ(pow(-x, 2).text(), "(-x)^2");
  EXPECT_EQ((-pow(x, 2)).text(), "-x^2");
  EXPECT_EQ(pow(pow(x, 2), 3).text(), "(x^2)^3");
  EXPECT_EQ(pow(x, -1).text(), "x^(-1)");
  EXPECT_EQ(pow(x, Formula(1) / 2).text(), "x^(1/2)");
  EXPECT_EQ((2 * cos(x + y)).text(), "2*cos(x + y)");
  EXPECT_EQ(atan2(y, x + 1).text(), "atan2(y, x + 1)");
  EXPECT_EQ((Formula("1/3") * x).text(), "(1/3)*x");
  EXPECT_EQ(("0.1" + x).text(), "0.1 + x");
}

TEST(Formula, TakesALiteralAsItIsWritten) {
  EXPECT_EQ((0.1_exact).text(), "0.1");
  EXPECT_EQ((0.12345678901234567890123_exact).text(), "0.12345678901234567890123");
  EXPECT_EQ((1.00000000000000000001_exact).text(), "1.00000000000000000001");
  EXPECT_EQ((12345678901234567890123_exact).text(), "12345678901234567890123");
  EXPECT_EQ((1'000.000'1e-3_exact * x).text(), "(1000.0001e-3)*x");
  EXPECT_EQ((1e-400_exact).text(), "1e-400");
  for (const char* text : {"0", "1", "1.", ".5", "1.5e5", "1E+5", "1e-05", "00.5", "1'000"})
    EXPECT_TRUE(is_decimal_literal(text)) << text;
  for (const char* text : {"", ".", "017", "0x1F", "0b1", "0x1.8p3", "1e", "1e+", "1.5f", "1..5"})
    EXPECT_FALSE(is_decimal_literal(text)) << text;
}

TEST(Formula, TakesTheBinaryValueOfADoubleWhereThatIsMeant) {
  EXPECT_EQ(exact_value_of(0.75).text(), "3/4");
  EXPECT_EQ(exact_value_of(0.1).text(), "3602879701896397/36028797018963968");
  EXPECT_EQ((exact_value_of(-0.5) * x).text(), "(-1/2)*x");
  EXPECT_GT(exact_value_of(5e-324).text().size(), 300U);
  EXPECT_THROW(static_cast<void>(exact_value_of(HUGE_VAL)), InputError);
  EXPECT_THROW(static_cast<void>(exact_value_of(std::nan(""))), InputError);
}

TEST(Formula, IsNotMadeFromADoubleThatHasBeenRounded) {
  static_assert(!std::is_constructible_v<Formula, double>);
  static_assert(!std::is_constructible_v<Formula, float>);
  static_assert(!std::is_constructible_v<Formula, bool>);
  static_assert(std::is_constructible_v<Formula, long long>);
  EXPECT_EQ(Formula(0).text(), "0");
  EXPECT_EQ(Formula(INT64_MIN).text(), "-9223372036854775808");
}

/// The same random expression in both representations.
struct Pair {
  Formula formula;
  ex value;
};

Pair random_pair(test::RandomSource& random, const std::vector<Pair>& leaves, int depth) {
  if (depth == 0) return leaves[random.below(leaves.size())];
  const Pair a = random_pair(random, leaves, depth - 1);
  const Pair b = random_pair(random, leaves, depth - 1);
  switch (random.below(6)) {
    case 0:
      return {a.formula + b.formula, a.value + b.value};
    case 1:
      return {a.formula - b.formula, a.value - b.value};
    case 2:
      return {a.formula * b.formula, a.value * b.value};
    case 3:
      return {-a.formula, -a.value};
    case 4:
      return {pow(a.formula, 2) / 3, pow(a.value, 2) / 3};
    default:
      return {a.formula / (pow(b.formula, 2) + 1), a.value / (pow(b.value, 2) + 1)};
  }
}

TEST(Formula, MeansWhatGiNaCMakesOfTheSameOperations) {
  test::RandomSource random(20260101);
  const std::vector<GiNaC::realsymbol> symbols = {GiNaC::realsymbol("x"), GiNaC::realsymbol("y")};
  const std::vector<Pair> leaves = {{x, symbols[0]},
                                    {y, symbols[1]},
                                    {"1/3", numeric(1, 3)},
                                    {-2, -2},
                                    {sin(x), sin(symbols[0])}};
  for (int i = 0; i < 300; ++i) {
    const Pair pair = random_pair(random, leaves, 1 + i % 4);
    KnownSymbols names(symbols);
    const ParsedExpression read = parse_expression(pair.formula.text(), names, {});
    EXPECT_TRUE(read.value.is_equal(pair.value)) << pair.formula.text();
    KnownSymbols again(symbols);
    const ParsedExpression back = parse_expression(Formula(pair.value).text(), again, {});
    EXPECT_TRUE((back.value - pair.value).expand().is_zero()) << Formula(pair.value).text();
  }
}

TEST(Formula, OfGiNaCHasTheSameTextInWhateverOrderTheSymbolsWereMade) {
  const auto text = [](bool reversed) {
    GiNaC::realsymbol first(reversed ? "b" : "a"), second(reversed ? "a" : "b");
    const ex a = reversed ? second : first, b = reversed ? first : second;
    return Formula(3 * a - b / 2 + sqrt(b) * pow(a, -2) + cos(a - b) + a * pow(a - b, 3) -
                   pow(b - a, 2))
        .text();
  };
  EXPECT_EQ(text(false), text(true));
}

TEST(Formula, OfGiNaCIsReadBackAsItWas) {
  const GiNaC::realsymbol a("a"), b("b");
  for (const ex& e : std::initializer_list<ex>{
           ex(a - b), ex(-a), a / b, pow(a + b, -2), sqrt(a * a + b * b), sin(a) * cos(b),
           pow(sqrt(a), 3), ex(numeric(-2, 3)), GiNaC::Pi * a / 180, atan2(a, b), abs(a), exp(-a),
           log(b), sqrt(ex(2)) * a, pow(a, -1) * pow(b, 3)}) {
    KnownSymbols names({a, b});
    const ParsedExpression read = parse_expression(Formula(e).text(), names, {});
    EXPECT_TRUE(read.value.is_equal(e)) << e << " became " << Formula(e).text();
  }
}

}  // namespace
}  // namespace regulus::detail::formula
