// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/enclose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail {
namespace {

using Expression = std::function<NodeId(ProgramBuilder&)>;

Program constant(const Expression& expression) {
  ProgramBuilder builder({}, {});
  builder.output(expression(builder));
  return std::move(builder).finish();
}

bool are_neighbours(const Interval& x) { return std::nextafter(x.lo, kInfinity) == x.hi; }

NodeId degrees(ProgramBuilder& b, int count) {
  return b.divide(b.multiply(b.constant(count), b.pi()), b.constant(180));
}

TEST(Enclose, GivesNeighboursOfIrrationalConstants) {
  const auto pi = enclose(constant([](auto& b) { return b.pi(); }));
  ASSERT_TRUE(pi);
  EXPECT_EQ(*pi, regulus::kPi);
  for (const int count : {1, 15, -10, 40}) {
    const auto angle = enclose(constant([&](auto& b) { return degrees(b, count); }));
    ASSERT_TRUE(angle);
    EXPECT_TRUE(are_neighbours(*angle));
    EXPECT_TRUE(contains(*angle, count * 3.14159265358979323846 / 180) ||
                std::fabs(angle->lo - count * 3.14159265358979323846 / 180) < 1e-15);
  }
}

TEST(Enclose, IsThinForDoublesOnly) {
  EXPECT_EQ(enclose(constant([](auto& b) { return b.constant("3/8"); })), Interval(0.375));
  const auto third = enclose(constant([](auto& b) { return b.constant("1/3"); }));
  ASSERT_TRUE(third);
  EXPECT_TRUE(are_neighbours(*third));
  EXPECT_LT(exact_rational(third->lo) * 3, 1);
  EXPECT_GT(exact_rational(third->hi) * 3, 1);
}

TEST(Enclose, RaisesThePrecisionThroughCancellation) {
  // (10^60 + π) − 10^60 = π; 128 bits and fewer lose it.
  const cln::cl_RA huge("1000000000000000000000000000000000000000000000000000000000000");
  const auto pi = enclose(constant(
      [&](auto& b) { return b.subtract(b.add(b.constant(huge), b.pi()), b.constant(huge)); }));
  EXPECT_EQ(pi, regulus::kPi);
}

TEST(Enclose, ContainsAnExactZeroItCannotProve) {
  const auto zero = enclose(constant([](auto& b) { return b.call(Op::kSin, b.pi()); }));
  ASSERT_TRUE(zero);
  EXPECT_TRUE(contains_zero(*zero));
  EXPECT_LT(mag(*zero), 1e-300);
}

TEST(Enclose, HasNoValueWhereAnExpressionMayBeUndefined) {
  const auto value = [](const Expression& e) { return enclose(constant(e)); };
  EXPECT_EQ(value([](auto& b) { return b.call(Op::kSqrt, b.constant(-1)); }), std::nullopt);
  EXPECT_EQ(value([](auto& b) { return b.divide(b.constant(1), b.constant(0)); }), std::nullopt);
  EXPECT_EQ(value([](auto& b) { return b.call(Op::kLog, b.call(Op::kSin, b.pi())); }),
            std::nullopt);
  EXPECT_EQ(
      value([](auto& b) { return b.multiply(b.constant(0), b.call(Op::kSqrt, b.constant(-1))); }),
      std::nullopt);
}

TEST(Enclose, RefusesVariables) {
  ProgramBuilder b({"x"}, {});
  b.output(b.input(0));
  EXPECT_THROW((void)enclose(std::move(b).finish()), std::invalid_argument);
}

TEST(Enclose, RoundsRangesOutwardAndInward) {
  const Program lo = constant([](auto& b) { return degrees(b, -15); });
  const Program hi = constant([](auto& b) { return degrees(b, 15); });
  const auto outer = enclose_outward(lo, hi);
  const auto inner = round_inward(lo, hi);
  ASSERT_TRUE(outer && inner);
  EXPECT_EQ(std::nextafter(outer->lo, kInfinity), inner->lo);
  EXPECT_EQ(std::nextafter(inner->hi, kInfinity), outer->hi);
}

TEST(Enclose, RoundsInwardToNothingWhenNoDoubleIsInside) {
  const Program third = constant([](auto& b) { return b.constant("1/3"); });
  EXPECT_EQ(round_inward(third, third), std::nullopt);
  const Program half = constant([](auto& b) { return b.constant("1/2"); });
  EXPECT_EQ(round_inward(half, half), Interval(0.5));
  EXPECT_EQ(round_inward(half, third), std::nullopt);
}

}  // namespace
}  // namespace regulus::detail
