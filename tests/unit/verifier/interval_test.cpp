// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/verifier/interval.hpp"

#include <arb.h>
#include <gtest/gtest.h>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/elementary.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::verifier {
namespace {

using detail::test::RandomSource;

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = std::numeric_limits<double>::max();

TEST(AStep, ReachesTheNextDoubleFromEveryOne) {
  RandomSource random(1);
  const auto check = [](double x) {
    EXPECT_GE(up(x), std::nextafter(x, kInfinity)) << x;
    EXPECT_LE(down(x), std::nextafter(x, -kInfinity)) << x;
  };
  for (const double x :
       {0.0, kSmallest, 0x1p-1022, 0x1p-969, 0x1p-968, 1.0, 0x1.fffffffffffffp+0, kLargest})
    for (const double sign : {-1.0, 1.0})
      for (const double y : {x, std::nextafter(x, 0.0), std::nextafter(x, kInfinity)})
        if (y < kInfinity) check(sign * y);
  for (int i = 0; i < 200000; ++i) {
    const double x = std::ldexp(1.0 + random.unit(), int(random.below(2046)) - 1023);
    check(random.one_in(2) ? x : -x);
  }
}

Interval random_interval(RandomSource& random) {
  const double a = detail::test::corner_double(random, 40),
               b = detail::test::corner_double(random, 40);
  return random.one_in(4) ? point(a) : Interval{std::min(a, b), std::max(a, b)};
}

double inside(RandomSource& random, Interval x) {
  return std::clamp(x.lo + random.unit() * (x.hi - x.lo), x.lo, x.hi);
}

/// Checks that Arb's values at points lie within the intervals for ranges around them.
template <class Exact, class Bound>
void expect_containment(Exact exact, Bound bound, int seed) {
  RandomSource random(std::uint64_t(seed) + 0);
  for (int i = 0; i < 20000; ++i) {
    const Interval x = random_interval(random), y = random_interval(random);
    const Interval result = bound(x, y);
    if (!is_bounded(result)) continue;
    Ball a(point(inside(random, x)), 400), b(point(inside(random, y)), 400), value;
    exact(value.get(), a.get(), b.get());
    if (!arb_is_finite(value.get())) continue;
    const Interval enclosure = value.enclosure();
    EXPECT_GE(enclosure.hi, result.lo);
    EXPECT_LE(enclosure.lo, result.hi);
  }
}

TEST(Arithmetic, ContainsTheExactResults) {
  const auto with = [](void (*operation)(arb_t, const arb_t, const arb_t, slong)) {
    return [operation](arb_ptr r, arb_srcptr a, arb_srcptr b) { operation(r, a, b, 400); };
  };
  expect_containment(
      with(arb_add), [](Interval x, Interval y) { return x + y; }, 1);
  expect_containment(
      with(arb_sub), [](Interval x, Interval y) { return x - y; }, 2);
  expect_containment(
      with(arb_mul), [](Interval x, Interval y) { return x * y; }, 3);
  expect_containment(
      with(arb_div), [](Interval x, Interval y) { return x / y; }, 4);
  for (const int n : {2, 3, 4, 7})
    expect_containment(
        [n](arb_ptr r, arb_srcptr a, arb_srcptr) { arb_pow_ui(r, a, ulong(n), 400); },
        [n](Interval x, Interval) { return power(x, n); }, 10 + n);
}

TEST(ElementaryFunctions, ContainTheExactResults) {
  for (const Op op : {Op::kSqrt, Op::kSin, Op::kCos, Op::kTan, Op::kAsin, Op::kAcos, Op::kAtan,
                      Op::kExp, Op::kLog})
    expect_containment(
        [op](arb_ptr r, arb_srcptr a, arb_srcptr) { function_in_arb(op)(r, a, 400); },
        [op](Interval x, Interval) {
          return is_bounded(x) && mag(x) < 700 ? apply(op, x) : everything();
        },
        20 + int(op));
  expect_containment([](arb_ptr r, arb_srcptr a, arb_srcptr b) { arb_atan2(r, a, b, 400); },
                     [](Interval y, Interval x) { return apply_atan2(y, x); }, 50);
}

TEST(ElementaryFunctions, AreNotBoundedWhereTheyAreNotDefined) {
  for (const auto& [op, x] :
       std::initializer_list<std::pair<Op, Interval>>{{Op::kSqrt, {-0x1p-1000, 1}},
                                                      {Op::kLog, {0, 1}},
                                                      {Op::kAsin, {0, std::nextafter(1.0, 2.0)}},
                                                      {Op::kAcos, {std::nextafter(-1.0, -2.0), 0}},
                                                      {Op::kTan, {1.5, 1.6}}})
    EXPECT_FALSE(is_bounded(apply(op, x))) << int(op);
  EXPECT_FALSE(is_bounded(apply_atan2({0, 0}, {-1, -1})));
  EXPECT_FALSE(is_bounded(point(1) / Interval{0, 1}));
}

TEST(SineAndCosine, ReachTheirExtremaWhereTheseAreInside) {
  EXPECT_EQ(apply(Op::kSin, {1.5, 1.6}).hi, 1.0);
  EXPECT_EQ(apply(Op::kCos, {-0.1, 0.1}).hi, 1.0);
  EXPECT_EQ(apply(Op::kCos, {3.1, 3.2}).lo, -1.0);
  EXPECT_LT(apply(Op::kCos, {0.1, 0.2}).hi, 1.0);
  EXPECT_EQ(apply(Op::kSin, {0, 100}).lo, -1.0);
}

TEST(AnOverflow, IsNotBounded) {
  EXPECT_FALSE(is_bounded(point(kLargest) + point(kLargest)));
  EXPECT_FALSE(is_bounded(point(kLargest) * Interval{-1, 2}));
}

}  // namespace
}  // namespace regulus::verifier
