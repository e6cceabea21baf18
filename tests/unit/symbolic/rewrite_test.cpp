// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/rewrite.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail::rewrite {
namespace {

const Expression x = variable("x"), y = variable("y"), z = variable("z");
const Expression a = variable("a"), b = variable("b"), c = variable("c");

Expression sine(const Expression& e) { return call(Call::kSin, {e}); }
Expression cosine(const Expression& e) { return call(Call::kCos, {e}); }

std::string form(const Expression& e, const RewriteOptions& options = {}) {
  Rewriter rewriter({"x", "y", "z", "a", "b", "c"}, {"k_1_1", "k_1_2"}, options);
  return to_string(rewriter.rewrite(e).expression);
}

TEST(Rewrite, CosineOfASum) {
  EXPECT_EQ(form(cosine(a) * cosine(b) - sine(a) * sine(b)), "cos(a + b)");
  EXPECT_EQ(form(cosine(a) * cosine(b) + sine(a) * sine(b)), "cos(a - b)");
}

TEST(Rewrite, SineOfASum) {
  EXPECT_EQ(form(sine(a) * cosine(b) + cosine(a) * sine(b)), "sin(a + b)");
  EXPECT_EQ(form(sine(a) * cosine(b) - cosine(a) * sine(b)), "sin(a - b)");
}

TEST(Rewrite, SumOfThreeAngles) {
  const Expression s = sine(a + b), k = cosine(a + b);
  EXPECT_EQ(form(k * cosine(c) - s * sine(c)), "cos(a + b + c)");
  const Expression ab = cosine(a) * cosine(b) - sine(a) * sine(b);
  const Expression sab = sine(a) * cosine(b) + cosine(a) * sine(b);
  EXPECT_EQ(form(x * (ab * cosine(c) - sab * sine(c))), "x*cos(a + b + c)");
}

TEST(Rewrite, SquaresOfSineAndCosineAddUpToOne) {
  EXPECT_EQ(form(power(sine(a), 2) + power(cosine(a), 2)), "1");
  EXPECT_EQ(form(x * power(sine(a), 2) + x * power(cosine(a), 2)), "x");
  EXPECT_EQ(form(Expression(3) * power(sine(a), 2) + Expression(5) * power(cosine(a), 2)),
            "2*cos(a)^2 + 3");
}

TEST(Rewrite, LeavesWhatIsWrittenWhereItIsToldTo) {
  RewriteOptions off;
  off.rewrite = false;
  EXPECT_EQ(form(x * y + x * z), "x*(y + z)");
  EXPECT_EQ(form(x * y + x * z, off), "x*y + x*z");
  EXPECT_EQ(form(power(x, 2) + Expression(2) * x), "(x + 1)^2 - 1");
  RewriteOptions no_squares;
  no_squares.nesting.complete_squares = false;
  EXPECT_EQ(form(power(x, 2) + Expression(2) * x, no_squares), "x*(x + 2)");
}

TEST(Rewrite, DoubleAngles) {
  EXPECT_EQ(form(Expression(2) * sine(a) * cosine(a)), "sin(2*a)");
  EXPECT_EQ(form(power(cosine(a), 2) - power(sine(a), 2)), "cos(2*a)");
}

TEST(Rewrite, OppositeAnglesHaveOneForm) {
  EXPECT_EQ(form(sine(a - b) + sine(b - a)), "0");
  EXPECT_EQ(form(cosine(a - b) - cosine(b - a)), "0");
}

TEST(Rewrite, EvenPowersOfOppositesHaveOneForm) {
  EXPECT_EQ(form(call(Call::kSqrt, {power(y - x, 2) + power(-z, 4)})), "sqrt(z^4 + (x - y)^2)");
}

TEST(Rewrite, ProductsAreFoundAgain) {
  EXPECT_EQ(form(x * y + Expression(2) * x + y + Expression(2)), "(x + 1)*(y + 2)");
  EXPECT_EQ(form(x * y * z + x * y + x * z + y * z + x + y + z + Expression(1)),
            "(x + 1)*(y + 1)*(z + 1)");
}

TEST(Rewrite, ArgumentsAndDenominatorsAreRewritten) {
  EXPECT_EQ(form(sine(x * y + x * z)), "sin(x*(y + z))");
  EXPECT_EQ(form(power(x * y + x * z, -1)), "1/(x*(y + z))");
  EXPECT_EQ(form(call(Call::kSqrt, {power(x, 2) - Expression(2) * x})), "sqrt((x - 1)^2 - 1)");
}

TEST(Rewrite, SumsOfSquaresUnderARootStaySumsOfSquares) {
  const Expression leg = power(x - cosine(a), 2) + power(y - sine(a), 2);
  EXPECT_EQ(form(call(Call::kSqrt, {leg})), "sqrt((x - cos(a))^2 + (y - sin(a))^2)");
}

TEST(Rewrite, EntriesOfKAreAddedBeforeTheyMeetVariables) {
  const Expression k1 = point("k_1_1"), k2 = point("k_1_2");
  EXPECT_EQ(form(k1 * (x + Expression(3)) + k2 * (x - Expression(3))),
            "x*(k_1_1 + k_1_2) + 3*(k_1_1 - k_1_2)");
}

TEST(Rewrite, TheWeightsDecideBetweenForms) {
  // Two legs with uncertain anchors: in this form each anchor occurs once and x twice.
  const Expression e = point("k_1_1") * a * (y - x) + point("k_1_2") * b * (z - x);
  const auto occurrences = [&](const Weights& weights) {
    RewriteOptions options;
    options.weights = weights;
    Rewriter rewriter({"x", "y", "z", "a", "b"}, {"k_1_1", "k_1_2"}, options);
    return count_occurrences(rewriter.rewrite(e).expression);
  };
  EXPECT_EQ(occurrences({}), (Occurrences{{"x", 2}, {"y", 1}, {"z", 1}, {"a", 1}, {"b", 1}}));
  EXPECT_EQ(occurrences({{"x", 16}}),
            (Occurrences{{"x", 1}, {"y", 1}, {"z", 1}, {"a", 2}, {"b", 2}}));
}

TEST(Rewrite, HugePowersAreNotMultipliedOut) {
  const Expression e = power(x + y, 1000);
  EXPECT_EQ(form(e), "(x + y)^1000");
}

TEST(Rewrite, ExpansionsThatExplodeAreGivenUp) {
  Expressions factors;
  for (int i = 0; i < 40; ++i)
    factors.push_back(variable(std::string("v").append(std::to_string(i))) + cosine(variable("w")) +
                      Expression(i));
  const Expression e = product(factors);
  EXPECT_EQ(form(e), to_string(e));
}

}  // namespace
}  // namespace regulus::detail::rewrite
