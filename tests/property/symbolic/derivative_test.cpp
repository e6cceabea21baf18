// SPDX-License-Identifier: GPL-3.0-or-later
// Compares derivatives with dual numbers (forward differentiation on exact values), which share
// nothing with the symbolic chain rule.
#include "codegen/kernel/symbolic/derivative.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/passes.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"
#include "tests/support/symbolic/exact_values.hpp"

namespace regulus::detail::test {
namespace {

struct Dual {
  cl_RA value = 0;
  cl_RA slope = 0;
};

class DualValues {
 public:
  DualValues(ExactValues& values, std::string with_respect_to)
      : values_(values), variable_(std::move(with_respect_to)) {}

  Dual operator()(const Expression& e) {
    switch (e.kind()) {
      case ExpressionKind::kSum: {
        Dual result;
        for (const Expression& term : e.operands()) {
          const Dual d = (*this)(term);
          result = {result.value + d.value, result.slope + d.slope};
        }
        return result;
      }
      case ExpressionKind::kProduct: {
        Dual result{1, 0};
        for (const Expression& factor : e.operands()) result = times(result, (*this)(factor));
        return result;
      }
      case ExpressionKind::kPower:
        return raised((*this)(e.operands()[0]), e.exponent());
      case ExpressionKind::kCall: {
        const cl_RA slope = (*this)(e.operands()[0]).slope;
        const CirclePoint at = values_.circle(e.operands()[0]);
        if (e.function() == Call::kSin) return {at.sine, at.cosine * slope};
        return {at.cosine, -at.sine * slope};
      }
      case ExpressionKind::kVariable:
        return {values_(e), e.name() == variable_ ? 1 : 0};
      default:
        return {values_(e), 0};
    }
  }

 private:
  static Dual times(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  static Dual raised(const Dual& base, int exponent) {
    Dual result{1, 0};
    for (int i = 0; i < std::abs(exponent); ++i) result = times(result, base);
    if (exponent > 0) return result;
    if (zerop(result.value)) throw std::domain_error("division by zero");
    return {1 / result.value, -result.slope / (result.value * result.value)};
  }

  ExactValues& values_;
  std::string variable_;
};

TEST(Derivative, AgreesWithDualNumbers) {
  std::mt19937_64 random(19);
  for (int i = 0; i < 300; ++i) {
    RandomExpressions expressions(random);
    const Expression e = expressions.polynomial(2) * power(expressions.polynomial(2), -2) +
                         expressions.polynomial(3);
    for (const std::string& name : {std::string("x"), std::string("a"), std::string("b")}) {
      ExactValues values(random);
      try {
        const cl_RA expected = DualValues(values, name)(e).slope;
        EXPECT_EQ(expected, values(Differentiator(name).derivative(e)))
            << "d/d" << name << " of " << to_string(e);
      } catch (const std::domain_error&) {
      }
    }
  }
}

TEST(Derivative, OfPolynomialsOverAtomsAgreesWithDualNumbers) {
  std::mt19937_64 random(23);
  for (int i = 0; i < 200; ++i) {
    RandomExpressions expressions(random);
    Rewriter rewriter(variable_names(), point_names());
    const Expression e =
        expressions.polynomial(2) * power(expressions.polynomial(1), -1) + expressions.leaf();
    const auto p = rewriter.expander().expand(e);
    ASSERT_TRUE(p.has_value());
    for (const std::string& name : {std::string("x"), std::string("a")}) {
      PolynomialDifferentiator by(name, rewriter.atoms(), rewriter.expander());
      const Expression slope = rewriter.best_form(by.derivative(*p)).expression;
      ExactValues values(random);
      try {
        const cl_RA expected = DualValues(values, name)(e).slope;
        EXPECT_EQ(expected, values(slope)) << "d/d" << name << " of " << to_string(e);
      } catch (const std::domain_error&) {
      }
    }
  }
}

// Tests functions without rational values, by identities whose derivative is known.
class InverseFunction : public ::testing::Test {
 protected:
  static cl_RA slope(const Expression& e, const std::string& name, const ValueOf& known) {
    return evaluate(Differentiator(name).derivative(e), known);
  }
  /// a is the angle with sine 3/5 and cosine 4/5; x is 7/2; exp(x) is 11.
  static std::optional<cl_RA> known(const Expression& e) {
    if (e.kind() == ExpressionKind::kVariable && e.name() == "x") return cl_RA(7) / 2;
    if (e.kind() != ExpressionKind::kCall) return std::nullopt;
    if (e.function() == Call::kSin) return cl_RA(3) / 5;
    if (e.function() == Call::kCos) return cl_RA(4) / 5;
    if (e.function() == Call::kTan) return cl_RA(3) / 4;
    if (e.function() == Call::kExp) return cl_RA(11);
    return std::nullopt;
  }
  const Expression a = variable("a"), x = variable("x");
  const Expression sine = call(Call::kSin, {a}), cosine = call(Call::kCos, {a});
};

TEST_F(InverseFunction, ArcSineUndoesTheSine) {
  EXPECT_EQ(slope(call(Call::kAsin, {sine}), "a", known), 1);
}
TEST_F(InverseFunction, ArcCosineUndoesTheCosine) {
  EXPECT_EQ(slope(call(Call::kAcos, {cosine}), "a", known), 1);
}
TEST_F(InverseFunction, ArcTangentUndoesTheTangent) {
  EXPECT_EQ(slope(call(Call::kAtan, {call(Call::kTan, {a})}), "a", known), 1);
}
TEST_F(InverseFunction, TangentIsSineOverCosine) {
  EXPECT_EQ(slope(call(Call::kTan, {a}), "a", known), slope(sine * power(cosine, -1), "a", known));
}
TEST_F(InverseFunction, PolarAngleOfThePointOnTheCircle) {
  EXPECT_EQ(slope(call(Call::kAtan2, {sine, cosine}), "a", known), 1);
  EXPECT_EQ(slope(call(Call::kAtan2, {cosine, sine}), "a", known), -1);
}
TEST_F(InverseFunction, LogarithmUndoesTheExponential) {
  EXPECT_EQ(slope(call(Call::kLog, {call(Call::kExp, {Expression(5) * x})}), "x", known), 5);
}
TEST_F(InverseFunction, RootUndoesTheSquare) {
  EXPECT_EQ(slope(call(Call::kSqrt, {power(x, 2)}), "x", known), 1);
}
TEST_F(InverseFunction, AbsHasTheSlopeOfItsSign) {
  EXPECT_EQ(slope(call(Call::kAbs, {x}), "x", known), 1);
  EXPECT_EQ(slope(call(Call::kAbs, {Expression(-2) * x}), "x", known), 2);
  EXPECT_EQ(slope(call(Call::kAbs, {Expression(3) - x}), "x", known), 1);
  EXPECT_EQ(slope(call(Call::kAbs, {Expression(4) - x}), "x", known), -1);
}

}  // namespace
}  // namespace regulus::detail::test
