// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/literal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

TEST(Literal, WritesSmallIntegersInDecimals) {
  EXPECT_EQ(literal(0.0), "0.0");
  EXPECT_EQ(literal(-0.0), "0.0");
  EXPECT_EQ(literal(-12.0), "-12.0");
  EXPECT_EQ(literal(180.0), "180.0");
}

TEST(Literal, WritesTheRestInHexadecimals) {
  EXPECT_EQ(literal(0.5), "0x1p-1");
  EXPECT_EQ(literal(-1.0 / 3), "-0x1.5555555555555p-2");
  EXPECT_EQ(literal(0x1p-1074), "0x0.0000000000001p-1022");
  EXPECT_EQ(literal(kInfinity), "__builtin_huge_val()");
}

TEST(Literal, ReadsBackAsTheSameDouble) {
  test::RandomSource random(3);
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = random.next();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x)) continue;
    ASSERT_EQ(std::strtod(literal(x).c_str(), nullptr), x) << literal(x);
  }
}

TEST(Literal, WritesBothBounds) { EXPECT_EQ(constant_literal({0.5, 3}), "constant(0x1p-1, 3.0)"); }

}  // namespace
}  // namespace regulus::detail
