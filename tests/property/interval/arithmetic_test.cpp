// SPDX-License-Identifier: GPL-3.0-or-later
// Compares + − · / sqr √ with MPFR on a million pairs each: the bounds contain it and are tight.
#include "runtime/interval/arithmetic.hpp"

#include <gtest/gtest.h>

#include "tests/property/interval/interval_printing.hpp"
#include "tests/support/corner_inputs.hpp"
#include "tests/support/mpfr_bounds.hpp"
#include "tests/support/ulps.hpp"

namespace regulus::detail::test {
namespace {

constexpr int kCases = 1'000'000;

using Binary = int (*)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);

/// Computes the tight interval around f(a, b), for doubles.
class TightBinary {
 public:
  explicit TightBinary(Binary f) : f_(f) {}

  Interval operator()(double a, double b) {
    a_ = a;
    b_ = b;
    const Tightest z =
        tightest(result_, [&](mpfr_ptr r, mpfr_rnd_t direction) { f_(r, a_, b_, direction); });
    return {z.lo, z.hi};
  }

  /// Returns the tight interval around f on all four pairs of ends. If f is monotone in each
  /// argument, this is that of the whole box.
  Interval operator()(Interval x, Interval y) {
    return hull(hull((*this)(x.lo, y.lo), (*this)(x.lo, y.hi)),
                hull((*this)(x.hi, y.lo), (*this)(x.hi, y.hi)));
  }

 private:
  Binary f_;
  MpfrNumber a_, b_, result_;
};

/// Expects tight bounds at points: both bounds are then tight roundings of one number.
void expect_tight_on_points(Interval (*f)(Interval, Interval), Binary exact,
                            bool (*defined)(double), std::uint64_t seed) {
  CornerInputs inputs(seed);
  TightBinary tight(exact);
  for (int i = 0; i < kCases; ++i) {
    const double a = inputs.number();
    const double b = inputs.number();
    if (!defined(b)) continue;
    ASSERT_EQ(f(a, b), tight(a, b)) << std::hexfloat << a << " and " << b;
  }
}

void expect_tight_on_intervals(Interval (*f)(Interval, Interval), Binary exact,
                               bool (*defined)(Interval), std::uint64_t seed) {
  CornerInputs inputs(seed);
  TightBinary tight(exact);
  for (int i = 0; i < kCases / 4; ++i) {
    const Interval x = inputs.interval();
    const Interval y = inputs.interval();
    if (!defined(y)) continue;
    ASSERT_EQ(f(x, y), tight(x, y)) << ::testing::PrintToString(x) << ::testing::PrintToString(y);
  }
}

bool everywhere(double) { return true; }
bool on_any_interval(Interval) { return true; }
bool not_zero(double x) { return x != 0; }
bool without_zero(Interval x) { return !contains_zero(x); }

Interval sum(Interval x, Interval y) { return x + y; }
Interval difference(Interval x, Interval y) { return x - y; }
Interval product(Interval x, Interval y) { return x * y; }
Interval ratio(Interval x, Interval y) { return x / y; }

TEST(Arithmetic, SumsOfDoublesAreTight) { expect_tight_on_points(sum, mpfr_add, everywhere, 1); }
TEST(Arithmetic, DifferencesOfDoublesAreTight) {
  expect_tight_on_points(difference, mpfr_sub, everywhere, 2);
}
TEST(Arithmetic, ProductsOfDoublesAreTight) {
  expect_tight_on_points(product, mpfr_mul, everywhere, 3);
}
TEST(Arithmetic, QuotientsOfDoublesAreTight) {
  expect_tight_on_points(ratio, mpfr_div, not_zero, 4);
}
TEST(Arithmetic, SumsOfIntervalsAreTight) {
  expect_tight_on_intervals(sum, mpfr_add, on_any_interval, 5);
}
TEST(Arithmetic, DifferencesOfIntervalsAreTight) {
  expect_tight_on_intervals(difference, mpfr_sub, on_any_interval, 6);
}
TEST(Arithmetic, ProductsOfIntervalsAreTight) {
  expect_tight_on_intervals(product, mpfr_mul, on_any_interval, 7);
}
TEST(Arithmetic, QuotientsOfIntervalsAreTight) {
  expect_tight_on_intervals(ratio, mpfr_div, without_zero, 8);
}

TEST(Arithmetic, SquareRootsAreTight) {
  CornerInputs inputs(9, 0);
  MpfrNumber x;
  MpfrNumber result;
  for (int i = 0; i < kCases; ++i) {
    const double a = inputs.number();
    x = a;
    const auto exact =
        tightest(result, [&](mpfr_ptr r, mpfr_rnd_t direction) { mpfr_sqrt(r, x, direction); });
    ASSERT_EQ(sqrt(Interval(a)), Interval(exact.lo, exact.hi)) << std::hexfloat << a;
  }
}

TEST(Arithmetic, SquaresAreTight) {
  CornerInputs inputs(10);
  TightBinary tight(mpfr_mul);
  for (int i = 0; i < kCases; ++i) {
    const Interval x = inputs.interval();
    const Interval exact = hull(tight(mig(x), mig(x)), tight(mag(x), mag(x)));
    ASSERT_EQ(sqr(x), exact) << ::testing::PrintToString(x);
  }
}

/// Uses that xⁿ is monotone on each side of 0, so the ends and 0 give its range.
Interval exact_power(Interval x, int n) {
  MpfrNumber base;
  MpfrNumber result;
  const auto at = [&](double a) {
    base = a;
    const auto z = tightest(
        result, [&](mpfr_ptr r, mpfr_rnd_t direction) { mpfr_pow_si(r, base, n, direction); });
    return Interval{z.lo, z.hi};
  };
  const Interval ends = hull(at(x.lo), at(x.hi));
  return contains_zero(x) ? hull(ends, at(0)) : ends;
}

TEST(Arithmetic, PowersContainTheExactRangeAndStayNearIt) {
  CornerInputs inputs(11);
  for (int i = 0; i < kCases / 4; ++i) {
    const Interval x = inputs.interval();
    const int n = inputs.below(30) - 12;
    if (n <= 0 && contains_zero(x)) continue;
    const Interval exact = exact_power(x, n);
    const Interval power = pow(x, n);
    ASSERT_TRUE(certain_subset(exact, power)) << ::testing::PrintToString(x) << "^" << n;
    ASSERT_LE(excess_ulps(power, exact), 40u) << ::testing::PrintToString(x) << "^" << n;
  }
}

/// A factor of a power may overflow or underflow only if the result does.
TEST(Arithmetic, PowersOfTheLargestAndTheSmallestDoublesAreNeighboursOfTheExactOnes) {
  const double ends[] = {kMaxDouble, 0x1p1023, 0x1p537,    0x1p512,   0x1.8p511,   0x1p358,
                         1.5,        0x1p-511, 0x1.8p-537, 0x1p-1022, 0x1.8p-1030, kMinSubnormal};
  for (const double end : ends)
    for (const double x : {end, -end})
      for (const int n : {-3, -2, -1, 2, 3}) {
        const Interval exact = exact_power(x, n);
        const Interval power = pow(Interval(x), n);
        ASSERT_TRUE(certain_subset(exact, power)) << std::hexfloat << x << "^" << n;
        ASSERT_LE(excess_ulps(power, exact), 4u) << std::hexfloat << x << "^" << n;
      }
  EXPECT_EQ(pow(Interval(kMaxDouble), -2), Interval(0.0, kMinSubnormal));
  EXPECT_EQ(pow(Interval(-kMaxDouble), -3), Interval(-kMinSubnormal, 0.0));
  EXPECT_EQ(pow(Interval(kMinSubnormal), -2), Interval(kMaxDouble, kInfinity));
}

TEST(Arithmetic, PowersOfTwoMoveExponentsAndRoundOutwardWhereTheyMust) {
  EXPECT_EQ(times_power_of_two(Interval(-3.0, 5.0), 1500 - 1499), Interval(-6.0, 10.0));
  EXPECT_EQ(times_power_of_two(Interval(0x1p-1000, 0x1p1000), -1000), Interval(0.0, 1.0));
  EXPECT_EQ(times_power_of_two(Interval(0x1p-1000), 2000), Interval(0x1p1000));
  EXPECT_EQ(times_power_of_two(Interval(1.0, 2.0), 5000), Interval(kMaxDouble, kInfinity));
  EXPECT_EQ(times_power_of_two(Interval(-1.0, 2.0), -5000),
            Interval(-kMinSubnormal, kMinSubnormal));
  EXPECT_EQ(times_power_of_two(Interval(0.0), 100000), Interval(0.0));
}

TEST(Arithmetic, HalvesMeetAndCoverTheInterval) {
  CornerInputs inputs(12);
  for (int i = 0; i < kCases; ++i) {
    const Interval x = inputs.interval();
    const auto halves = bisect(x);
    const bool splittable = next_up(x.lo) < x.hi;
    ASSERT_EQ(halves.has_value(), splittable) << ::testing::PrintToString(x);
    if (!halves) continue;
    ASSERT_EQ(halves->left.lo, x.lo);
    ASSERT_EQ(halves->left.hi, halves->right.lo);
    ASSERT_EQ(halves->right.hi, x.hi);
    ASSERT_LT(halves->left.hi, x.hi);
    ASSERT_GT(halves->right.lo, x.lo);
  }
}

TEST(Arithmetic, MidpointAndRadiusCoverTheInterval) {
  CornerInputs inputs(13);
  for (int i = 0; i < kCases; ++i) {
    const Interval x = inputs.interval();
    const double m = mid(x);
    const double r = rad_ru(x);
    ASSERT_TRUE(std::isfinite(m) && contains(x, m)) << ::testing::PrintToString(x);
    // m ± r is exact enough here: the radius was rounded up from both differences.
    ASSERT_LE(sub_rd(x.hi, m), r) << ::testing::PrintToString(x);
    ASSERT_LE(sub_rd(m, x.lo), r) << ::testing::PrintToString(x);
    ASSERT_TRUE(certain_subset(x, Interval(m) + Interval(-r, r))) << ::testing::PrintToString(x);
  }
}

}  // namespace
}  // namespace regulus::detail::test
