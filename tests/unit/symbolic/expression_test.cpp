// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/expression.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail::expression_test {
namespace {

const Expression x = variable("x"), y = variable("y"), k = point("k_1_1");

cln::cl_RA third() { return cln::cl_RA(1) / 3; }

TEST(Expression, FactoredFormsAreNotMultipliedOut) {
  const Expression e = product({Expression(2), x + y});
  EXPECT_EQ(to_string(e), "2*(x + y)");
  EXPECT_EQ(total(count_occurrences(e)), 2u);
}

TEST(Expression, OperandsHaveOneOrder) {
  EXPECT_TRUE(sum({x, y, k}) == sum({k, y, x}));
  EXPECT_TRUE(product({x, sum({y, k}), Expression(3)}) == product({Expression(3), sum({k, y}), x}));
  EXPECT_EQ(sum({x, y, k}).hash(), sum({k, y, x}).hash());
}

TEST(Expression, DigitsInNamesCompareAsNumbers) {
  EXPECT_LT(compare(point("k_1_2"), point("k_1_10")), 0);
  EXPECT_LT(compare(point("k_2_1"), point("k_10_1")), 0);
  EXPECT_NE(compare(variable("a1"), variable("a01")), 0);
  EXPECT_EQ(compare(variable("a01"), variable("a1")), -compare(variable("a1"), variable("a01")));
}

TEST(Expression, OrderIsTotal) {
  const Expressions all = {Expression(0),
                           Expression(third()),
                           pi(),
                           k,
                           x,
                           y,
                           power(x, 2),
                           power(x, -1),
                           x + y,
                           x - y,
                           x * y,
                           -x,
                           call(Call::kSin, {x}),
                           call(Call::kCos, {x}),
                           Expression(2) * x};
  for (const Expression& a : all)
    for (const Expression& b : all) {
      EXPECT_EQ(compare(a, b), -compare(b, a));
      EXPECT_EQ(compare(a, b) == 0, a.identity() == b.identity());
      for (const Expression& c : all)
        EXPECT_TRUE(compare(a, b) > 0 || compare(b, c) > 0 || compare(a, c) <= 0);
    }
}

TEST(Expression, ConstantsAreFoldedExactly) {
  EXPECT_EQ(to_string(sum({Expression(third()), x, Expression(third())})), "x + 2/3");
  EXPECT_EQ(to_string(power(Expression(third()), -2)), "9");
  EXPECT_TRUE(sum({x, Expression(0)}) == x);
  EXPECT_TRUE(product({x, Expression(third()), Expression(3)}) == x);
}

TEST(Expression, ZeroTimesKeepsWhatCanBeUndefined) {
  EXPECT_TRUE(product({Expression(0), x}).is_constant(0));
  const Expression kept = product({Expression(0), power(x, -1), y});
  EXPECT_EQ(to_string(kept), "0/x");
  EXPECT_FALSE(kept.is_total());
  EXPECT_FALSE(power(power(x, -1), 0).is_constant(1));
}

TEST(Expression, NegativePowersOfNegativePowersStay) {
  const Expression e = power(power(x, -1), -1);
  EXPECT_FALSE(e == x);
  EXPECT_FALSE(e.is_total());
  EXPECT_TRUE(power(power(x, 2), -3) == power(x, -6));
}

TEST(Expression, DivisionByTheConstantZeroStaysUndefined) {
  EXPECT_FALSE(power(Expression(0), -1).is_total());
  EXPECT_THROW(static_cast<void>(evaluate(power(Expression(0), -1),
                                          [](const Expression&) { return std::nullopt; })),
               std::domain_error);
}

TEST(Expression, RootOfANegativeNumberIsNotTotal) {
  EXPECT_TRUE(call(Call::kSqrt, {Expression(3)}).is_total());
  EXPECT_FALSE(call(Call::kSqrt, {Expression(-3)}).is_total());
  EXPECT_FALSE(call(Call::kSqrt, {x}).is_total());
  EXPECT_FALSE(call(Call::kAtan2, {x, y}).is_total());
  EXPECT_TRUE(call(Call::kAtan, {x}).is_total());
}

TEST(Expression, SignIsNormalizedTheSameForBothSigns) {
  const Expression form = x - Expression(2) * y + Expression(third());
  const Signed plus = normalize_sign(form), minus = normalize_sign(divide_by(form, -1));
  EXPECT_TRUE(plus.form == minus.form);
  EXPECT_EQ(plus.sign, -minus.sign);
}

struct Printed {
  Expression expression;
  const char* text;
};

TEST(Print, IsTheSyntaxOfModelFiles) {
  const Expression s = call(Call::kSin, {x});
  const Printed all[] = {
      {x - y, "x - y"},
      {-x - y, "-x - y"},
      {Expression(2) * x * y, "2*x*y"},
      {product({x + y, x - y}), "(x + y)*(x - y)"},
      {-(x + y), "-(x + y)"},
      {y - product({Expression(1), x + y}), "y - (x + y)"},
      {sum({Expression(3), product({Expression(-1), k + x})}), "-(k_1_1 + x) + 3"},
      {power(x + y, 2), "(x + y)^2"},
      {power(-x, 2), "(-x)^2"},
      {x * power(y, -1), "x/y"},
      {x * power(y, -2) * power(k, -1), "x/(k_1_1*y^2)"},
      {power(x + y, -1), "1/(x + y)"},
      {power(power(x, -1), 2), "1/x^2"},
      {Expression(third()) * x, "1/3*x"},
      {Expression(-third()) * s, "-1/3*sin(x)"},
      {power(s, 2), "sin(x)^2"},
      {call(Call::kAtan2, {y, x}), "atan2(y, x)"},
      {pi() * x, "pi*x"},
      {x - Expression(third()), "x - 1/3"}};
  for (const Printed& p : all) EXPECT_EQ(to_string(p.expression), p.text);
}

TEST(Measure, OccurrencesCountThePrintedForm) {
  const Expression shared = x + y;
  const Expression e = product({shared, call(Call::kSin, {shared})}) + power(shared, 3);
  const Occurrences counts = count_occurrences(e);
  EXPECT_EQ(counts.at("x"), 3u);
  EXPECT_EQ(counts.at("y"), 3u);
}

TEST(Measure, SharedSubExpressionsDoNotMakeCountingExponential) {
  Expression e = x + Expression(1);
  for (int i = 0; i < 200; ++i) e = product({e, e + y});
  EXPECT_EQ(count_occurrences(e).at("x"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_LT(count_operations({e}), 30000u);
}

TEST(Measure, SineAndCosineTogetherWeighAsOneVariable) {
  const Expression pair = call(Call::kSin, {x}) + call(Call::kCos, {x});
  EXPECT_EQ(width_cost(pair), width_cost(y));
  EXPECT_EQ(width_cost(x * y, {{"x", 10}}), 22u);
}

TEST(Evaluate, RootsOfSquaresAreRational) {
  const auto known = [](const Expression& e) -> std::optional<cln::cl_RA> {
    if (e.kind() == ExpressionKind::kVariable) return cln::cl_RA(9) / 4;
    return std::nullopt;
  };
  EXPECT_EQ(evaluate(call(Call::kSqrt, {x}), known), cln::cl_RA(3) / 2);
  EXPECT_EQ(evaluate(call(Call::kAbs, {-x}), known), cln::cl_RA(9) / 4);
  EXPECT_THROW(static_cast<void>(evaluate(call(Call::kSin, {x}), known)), std::domain_error);
  EXPECT_THROW(static_cast<void>(evaluate(k, known)), std::domain_error);
}

TEST(Substitute, ReplacesWhereverItOccurs) {
  const Expression e = product({x + y, call(Call::kCos, {x})});
  const Expression replaced = substitute(e, [](const Expression& s) -> std::optional<Expression> {
    if (s == x) return Expression(0);
    return std::nullopt;
  });
  EXPECT_TRUE(replaced == y);
}

}  // namespace
}  // namespace regulus::detail::expression_test
