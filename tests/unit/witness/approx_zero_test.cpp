// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/witness/approx_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace regulus::detail {
namespace {

/// Looks as often as that narrows, at most six times.
template <typename Function>
ApproxZero narrowed(Function&& f) {
  ApproxZero zero(f(0.0), f(1.0));
  for (int look = 0; look < 6; ++look) {
    double part[kLanes];
    const std::size_t count = zero.choose_parts(part);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_LT(k == 0 ? 0.0 : part[k - 1], part[k]);
      EXPECT_LT(part[k], 1.0);
    }
    for (std::size_t k = 0; k < count; ++k) zero.learn(part[k], f(part[k]));
  }
  return zero;
}

TEST(ApproxZero, IsBetweenTheEndsAndNarrow) {
  for (const double root : {0.001, 0.1234567, 0.5, 0.75, 0.999999}) {
    const auto curved = [&](double s) { return std::exp(3.0 * root) - std::exp(3.0 * s); };
    const ApproxZero zero = narrowed(curved);
    EXPECT_LE(zero.from(), root + 1e-12);  // the function itself is rounded
    EXPECT_GE(zero.to(), root - 1e-12);
    EXPECT_LT(zero.width(), 0x1p-36) << root;
  }
}

TEST(ApproxZero, IsKeptIfInterpolationMisleads) {
  const auto flat = [](double s) { return std::pow(0.3 - s, 9.0) * 1e-30; };
  const ApproxZero zero = narrowed(flat);
  EXPECT_LE(zero.from(), 0.3);
  EXPECT_GE(zero.to(), 0.3);
  EXPECT_LT(zero.width(), 1.0 / 9.0);
}

TEST(ApproxZero, StaysInTheSegmentWithoutValues) {
  const ApproxZero zero =
      narrowed([](double s) { return s == 0.0 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_LE(0.0, zero.from());
  EXPECT_LE(zero.to(), 1.0);
}

/// Halving [0, 1] towards 0.3 four times gives [0.25, 0.3125].
TEST(ApproxZero, IsHalvedWhileOneHalfHasIt) {
  ApproxZero zero(1.0, -1.0);
  zero.learn(0.26, 1.0);
  zero.learn(0.31, -1.0);
  EXPECT_EQ(zero.approx_halvings(36), 4U);
  EXPECT_EQ(zero.approx_halvings(3), 3U);
}

}  // namespace
}  // namespace regulus::detail
