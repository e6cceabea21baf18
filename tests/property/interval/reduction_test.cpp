// SPDX-License-Identifier: GPL-3.0-or-later
// Measures against Arb what reduce and quotient of runtime/interval/elementary/trigonometric.hpp
// guarantee to the evaluators.
#include <arb.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "runtime/interval/elementary/trigonometric.hpp"
#include "tests/support/corner_inputs.hpp"

namespace regulus::detail::test::reduction {
namespace {

constexpr slong kPrecision = 300;
constexpr int kCases = 200'000;

class Ball {
 public:
  Ball() { arb_init(value_); }
  explicit Ball(double x) : Ball() { arb_set_d(value_, x); }
  ~Ball() { arb_clear(value_); }
  Ball(const Ball&) = delete;
  Ball& operator=(const Ball&) = delete;
  operator arb_ptr() { return value_; }

 private:
  arb_t value_;
};

/// Returns true if |difference| < bound·2^exponent is certain.
bool certain_within(Ball& difference, double bound, slong exponent) {
  Ball limit(bound);
  arb_mul_2exp_si(limit, limit, exponent);
  arb_abs(difference, difference);
  return arb_lt(difference, limit) != 0;
}

TEST(Reduction, LeavesTheExactRemainderButFor2ToTheMinus69) {
  CornerInputs inputs(41, -elementary::kReductionLimit, elementary::kReductionLimit);
  inputs.with({0.7853981633974483, elementary::kReductionLimit}).with_quarter_turns();
  Ball half_pi;
  arb_const_pi(half_pi, kPrecision);
  arb_mul_2exp_si(half_pi, half_pi, -1);
  for (int i = 0; i < kCases; ++i) {
    const double x = inputs.number();
    const auto turns = elementary::reduce(x);
    const auto k = static_cast<std::int64_t>(turns.k - std::bit_cast<std::uint64_t>(0x1.8p52));
    const auto [high, low] = turns.r;
    ASSERT_TRUE(turns.valid);
    ASSERT_LE(std::fabs(high), 0x1.921fbp-1 + 0x1p-20) << std::hexfloat << x;
    ASSERT_LE(std::fabs(low), std::fmax(0x1p-52 * std::fabs(high), 0x1p-83)) << std::hexfloat << x;
    ASSERT_EQ(high == 0, x == 0) << std::hexfloat << x;
    Ball difference(x);
    Ball kept(low);
    Ball part(high);
    arb_submul_si(difference, half_pi, k, kPrecision);
    arb_add(kept, kept, part, kPrecision);
    arb_sub(difference, difference, kept, kPrecision);
    ASSERT_TRUE(x == 0 || k == 0 || certain_within(difference, std::fabs(high), -69))
        << std::hexfloat << x;
    if (k == 0) {
      ASSERT_EQ(high, x);
      ASSERT_EQ(low, 0);
    }
  }
}

TEST(Reduction, RefusesWhatIsBeyondItsLimit) {
  for (const double x : {next_up(elementary::kReductionLimit), 0x1p400, kInfinity, std::nan("")}) {
    EXPECT_FALSE(elementary::reduce(x).valid) << x;
    EXPECT_FALSE(elementary::reduce(-x).valid) << x;
  }
  EXPECT_TRUE(elementary::reduce(elementary::kReductionLimit).valid);
}

/// The last rounding is allowed; the error before it must be below 2^-100.
TEST(Quotient, OfUnevaluatedSumsIsNearest) {
  CornerInputs inputs(42);
  for (int i = 0; i < kCases; ++i) {
    const double n = std::ldexp(inputs.uniform(0.5, 1), -inputs.below(60));
    const double d = inputs.uniform(0.5, 1);
    const double n_low = n * inputs.uniform(-0.125, 0.125);
    const double d_low = d * inputs.uniform(-0.25, 0.25);
    const double q = elementary::quotient<double>({n, n_low}, {d, d_low});
    Ball exact(n), divisor(d), part(n_low);
    arb_add(exact, exact, part, kPrecision);
    arb_set_d(part, d_low);
    arb_add(divisor, divisor, part, kPrecision);
    arb_div(exact, exact, divisor, kPrecision);
    Ball difference(q);
    arb_sub(difference, difference, exact, kPrecision);
    const double half_distance = std::ldexp(1.0, std::ilogb(q) - 53);
    ASSERT_TRUE(certain_within(difference, half_distance * (1 + 0x1p-46), 0))
        << std::hexfloat << n << ' ' << n_low << ' ' << d << ' ' << d_low;
  }
}

}  // namespace
}  // namespace regulus::detail::test::reduction
