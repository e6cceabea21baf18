// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/crank.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail {
namespace {

Expression rational(int p, int q) { return Expression(cln::cl_RA(p) / q); }

/// A crank of length 2 with the rod's end at (x + 1, 2·y); k = ((x + 1)² + 4·y² − 5)/4.
struct Leg {
  Expression f = variable("x") + 1;
  Expression g = variable("y");  // half of the distance
  Expression square = power(f, 2) + Expression(4) * power(g, 2) - 5;
  Expression q = power(f, 2) + Expression(4) * power(g, 2);
  Expression w = call(Call::kSqrt, {q - rational(1, 16) * power(square, 2)});
  Expression cosine = rational(1, 4) * square * f + Expression(2) * w * g;
  Expression sine = rational(1, 2) * square * g - w * f;
};

TEST(Crank, IsFoundWithItsLength) {
  const Leg leg;
  const auto found = find_crank(Expression(6) * leg.cosine, leg.q);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_sine);
  EXPECT_EQ(found->crank.sign, 1);
  ASSERT_TRUE(found->crank.length);
  // The scale of f and g is that of the second one: (f, g) is ((x + 1)/2, y), and the crank is 1 long.
  EXPECT_TRUE(*found->crank.length == 1);
  EXPECT_EQ(to_string(found->crank.f), "1/2*(x + 1)");
  EXPECT_EQ(to_string(found->crank.g), "y");
}

TEST(Crank, HasASineAndTwoModes) {
  const Leg leg;
  const auto sine = find_crank(leg.sine, leg.q);
  ASSERT_TRUE(sine);
  EXPECT_TRUE(sine->is_sine);
  EXPECT_EQ(sine->crank.sign, 1);
  const Expression other = rational(1, 2) * leg.square * leg.g + leg.w * leg.f;
  const auto mode = find_crank(other, leg.q);
  ASSERT_TRUE(mode);
  EXPECT_TRUE(mode->is_sine);
  EXPECT_EQ(mode->crank.sign, -1);
}

TEST(Crank, IsNotFoundInWhatOnlyLooksLikeOne) {
  const Leg leg;
  EXPECT_FALSE(find_crank(leg.cosine + leg.w, leg.q));
  EXPECT_FALSE(find_crank(leg.cosine + 1, leg.q));
  EXPECT_FALSE(find_crank(rational(1, 4) * leg.square * leg.f + leg.w * leg.g, leg.q));
  EXPECT_FALSE(find_crank(leg.cosine, leg.q + 1));
  EXPECT_FALSE(find_crank(leg.cosine, power(leg.f, 2) + power(leg.g, 2)));
  const Expression radicand = leg.q - rational(1, 16) * power(leg.square, 2) + variable("x");
  const Expression w = call(Call::kSqrt, {radicand});
  EXPECT_FALSE(find_crank(rational(1, 4) * leg.square * leg.f + Expression(2) * w * leg.g, leg.q));
}

}  // namespace
}  // namespace regulus::detail
