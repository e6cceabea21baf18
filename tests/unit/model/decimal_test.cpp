// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace regulus::detail {
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

TEST(TomlNumber, MeansExactlyWhatItSays) {
  const auto value = [](const char* text) { return exact_toml_number(text).value(); };
  EXPECT_EQ(value("+1.5"), numeric(3, 2));
  EXPECT_EQ(value("-0.0"), numeric(0));
  EXPECT_EQ(value("1_000.000_1"), numeric(10000001, 10000));
  EXPECT_EQ(value("1e+05"), numeric(100000));
  EXPECT_EQ(value("1E-0_2"), numeric(1, 100));
  EXPECT_EQ(value("0xdead_BEEF"), numeric("3735928559"));
  EXPECT_EQ(value("0o0_17"), numeric(15));
  EXPECT_EQ(value("0b1_01"), numeric(5));
  EXPECT_EQ(value("-17"), numeric(-17));
  EXPECT_EQ(value("9007199254740993.0"), numeric("9007199254740993"));
  EXPECT_EQ(value("1e-400"), numeric(10).power(numeric(-400)));
  EXPECT_EQ(value("3e-324"), 3 * numeric(10).power(numeric(-324)));
  EXPECT_EQ(value("1.00000000000000000001") - 1, numeric(10).power(numeric(-20)));
}

TEST(TomlNumber, IsNothingThatTomlDoesNotCallANumber) {
  for (const char* text :
       {"",      "+",     "-",     ".5",    "3.",         "1e",    "1e+",  "01",   "-01.5", "1_",
        "_1",    "1__0",  "1_.5",  "1._5",  "1e_5",       "0x",    "0x_",  "0x_1", "0x1_",  "0X1",
        "0b2",   "0o8",   "0xg",   "+-1",   "--1",        "inf",   "nan",  "+inf", "1 ",    " 1",
        "1.5.5", "1e5e5", "1e5.0", "0x1p3", "1979-05-27", "12:30", "true", "1,"})
    EXPECT_FALSE(exact_toml_number(text)) << text;
}

TEST(TomlNumber, RefusesWhatWouldBeEnormous) {
  EXPECT_FALSE(exact_toml_number("1e1001"));
  EXPECT_FALSE(exact_toml_number("0e-5000"));
  EXPECT_FALSE(exact_toml_number("0x" + std::string(1001, '1')));
}

TEST(ExactValue, IsTheBinaryNumber) {
  EXPECT_EQ(exact_value(0.1), numeric("3602879701896397") / numeric(2).power(numeric(55)));
  EXPECT_EQ(exact_value(-0.75), numeric(-3, 4));
  EXPECT_EQ(exact_value(5e-324), numeric(2).power(numeric(-1074)));
  EXPECT_EQ(exact_value(std::numeric_limits<double>::max()),
            (numeric(2).power(numeric(53)) - 1) * numeric(2).power(numeric(971)));
  EXPECT_EQ(exact_value(-0.0), numeric(0));
}

TEST(RoundsTo, KnowsTheNearestDoubleAndBothOfATie) {
  const numeric tenth(1, 10), tiny = numeric(10).power(numeric(-400));
  EXPECT_TRUE(rounds_to(tenth, 0.1));
  EXPECT_TRUE(rounds_to(-tenth, -0.1));
  EXPECT_FALSE(rounds_to(tenth, std::nextafter(0.1, 1)));
  EXPECT_FALSE(rounds_to(tenth, -0.1));
  const numeric tie = 1 + numeric(2).power(numeric(-53));
  EXPECT_TRUE(rounds_to(tie, 1));
  EXPECT_TRUE(rounds_to(tie, std::nextafter(1.0, 2)));
  EXPECT_FALSE(rounds_to(tie + tiny, 1));
  EXPECT_TRUE(rounds_to(tiny, 0));
  EXPECT_FALSE(rounds_to(tiny, 5e-324));
  EXPECT_FALSE(rounds_to(numeric(2).power(numeric(1024)), std::numeric_limits<double>::max()));
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
}  // namespace regulus::detail
