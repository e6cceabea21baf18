// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/model/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace regulus::codegen {
namespace {

using GiNaC::numeric;

numeric exact(const std::string& text) { return exact_decimal(text).value(); }

TEST(Decimal, MeansExactlyWhatItSays) {
  EXPECT_EQ(exact("0.1"), numeric(1, 10));
  EXPECT_EQ(exact("12"), numeric(12));
  EXPECT_EQ(exact("007"), numeric(7));
  EXPECT_EQ(exact(".5"), numeric(1, 2));
  EXPECT_EQ(exact("3."), numeric(3));
  EXPECT_EQ(exact("1.5e-3"), numeric(3, 2000));
  EXPECT_EQ(exact("2.5E+2"), numeric(250));
  EXPECT_EQ(exact("0e0"), numeric(0));
  EXPECT_EQ(exact("0.000"), numeric(0));
}

TEST(Decimal, KeepsMoreDigitsThanADoubleHas) {
  const numeric x = exact("0.1000000000000000000000000000000000000001");
  EXPECT_EQ(x - numeric(1, 10), numeric(1, 10).power(numeric(40)));
}

TEST(Decimal, IsNeverAFloat) {
  for (const char* text : {"0.1", "1e300", "1e-300", "3.14159"})
    EXPECT_TRUE(exact(text).is_rational()) << text;
}

TEST(Decimal, RefusesWhatWouldBeEnormous) {
  EXPECT_FALSE(exact_decimal("1e1001"));
  EXPECT_FALSE(exact_decimal("1e-1001"));
  EXPECT_FALSE(exact_decimal("1e99999999999999999999999"));
  EXPECT_FALSE(exact_decimal(std::string(1001, '1')));
  EXPECT_TRUE(exact_decimal("1e1000"));
  EXPECT_TRUE(exact_decimal(std::string(1000, '1')));
}

TEST(ShortestDecimal, IsTheDecimalThatWasWritten) {
  EXPECT_EQ(shortest_decimal(0.1), numeric(1, 10));
  EXPECT_EQ(shortest_decimal(-0.3), numeric(-3, 10));
  EXPECT_EQ(shortest_decimal(1e22), numeric(10).power(numeric(22)));
  EXPECT_EQ(shortest_decimal(5e-324), numeric(5) * numeric(10).power(numeric(-324)));
  EXPECT_EQ(shortest_decimal(-0.0), numeric(0));
}

TEST(ShortestDecimal, ReadsBackAsTheSameDouble) {
  std::mt19937_64 random(20070601);
  for (int i = 0; i < 2000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x) || std::fabs(x) < std::numeric_limits<double>::min()) continue;
    EXPECT_EQ(shortest_decimal(x).to_double(), x);
  }
}

TEST(ExactInteger, TakesAll64Bits) {
  EXPECT_EQ(exact_integer(std::numeric_limits<std::int64_t>::max()),
            numeric(2).power(numeric(63)) - 1);
  EXPECT_EQ(exact_integer(std::numeric_limits<std::int64_t>::min()),
            -numeric(2).power(numeric(63)));
}

}  // namespace
}  // namespace regulus::codegen
