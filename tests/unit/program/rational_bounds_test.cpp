// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/rational_bounds.hpp"

#include <cln/integer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

using Limits = std::numeric_limits<double>;

cln::cl_RA power_of_two(int exponent) {
  const cln::cl_I power = cln::ash(1, exponent < 0 ? -exponent : exponent);
  return exponent < 0 ? cln::cl_RA(1) / power : cln::cl_RA(power);
}

/// Returns any double except NaN and infinities; all exponents are equally likely.
double any_double(test::RandomSource& random) {
  for (;;) {
    const std::uint64_t bits = random.next();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) return x;
  }
}

TEST(RationalBounds, ReadsDoublesExactly) {
  EXPECT_EQ(exact_rational(0.1), cln::cl_RA("3602879701896397/36028797018963968"));
  EXPECT_EQ(exact_rational(-3), cln::cl_RA(-3));
  EXPECT_EQ(exact_rational(Limits::denorm_min()), power_of_two(-1074));
  EXPECT_EQ(exact_rational(-0.0), cln::cl_RA(0));
}

TEST(RationalBounds, ReturnsEveryDoubleToItself) {
  test::RandomSource random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = any_double(random);
    ASSERT_EQ(round_down(exact_rational(x)), x);
    ASSERT_EQ(round_up(exact_rational(x)), x);
  }
}

/// Tests rationals strictly between neighbours: lo + (hi − lo)·f, 0 < f < 1.
TEST(RationalBounds, RoundsToTheNeighboursOfEveryRational) {
  test::RandomSource random(2);
  const std::vector<cln::cl_RA> fractions = {cln::cl_RA("1/2"), cln::cl_RA("1/3"),
                                             power_of_two(-200), 1 - power_of_two(-200)};
  for (int i = 0; i < 100000; ++i) {
    const double lo = any_double(random);
    const double hi = std::nextafter(lo, Limits::infinity());
    if (std::isinf(hi)) continue;
    const cln::cl_RA between = exact_rational(lo) + (exact_rational(hi) - exact_rational(lo)) *
                                                        fractions[random.below(fractions.size())];
    ASSERT_EQ(round_down(between), lo);
    ASSERT_EQ(round_up(between), hi);
  }
}

TEST(RationalBounds, StraddlesWhatIsSmallerThanTheSmallestDouble) {
  const cln::cl_RA tiny = power_of_two(-1075);
  EXPECT_EQ(round_down(tiny), 0.0);
  EXPECT_EQ(round_up(tiny), Limits::denorm_min());
  EXPECT_EQ(round_down(-tiny), -Limits::denorm_min());
  EXPECT_EQ(round_up(-tiny), 0.0);
}

TEST(RationalBounds, NeverGivesMinusZero) {
  EXPECT_FALSE(std::signbit(round_up(-power_of_two(-2000))));
  EXPECT_FALSE(std::signbit(round_down(cln::cl_RA(0))));
  EXPECT_FALSE(std::signbit(round_up(cln::cl_RA(0))));
  EXPECT_FALSE(std::signbit(round_down(power_of_two(-2000))));
}

TEST(RationalBounds, GoesToInfinityOutwardOnly) {
  for (const cln::cl_RA& huge : {power_of_two(1024), power_of_two(5000),
                                 cln::cl_RA(exact_rational(Limits::max()) + power_of_two(-9))}) {
    EXPECT_EQ(round_down(huge), Limits::max());
    EXPECT_EQ(round_up(huge), Limits::infinity());
    EXPECT_EQ(round_down(-huge), -Limits::infinity());
    EXPECT_EQ(round_up(-huge), -Limits::max());
  }
}

TEST(RationalBounds, BoundsTheExponent) {
  for (const int e : {-1100, -1, 0, 1, 52, 53, 2000}) {
    EXPECT_EQ(exponent_bound(power_of_two(e)), e + 1);
    EXPECT_EQ(exponent_bound(-power_of_two(e) * 3 / 2), e + 1);
  }
}

}  // namespace
}  // namespace regulus::detail
