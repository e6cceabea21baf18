// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/certain_sign.hpp"

#include <gtest/gtest.h>

#include "codegen/model/exact/expression_parser.hpp"

namespace regulus::detail {
namespace {

CertainSign sign(const char* text) {
  return certain_sign(parse_constant(text, {.file = "", .key = "test"}).value);
}

TEST(CertainSign, OfRationalsIsExact) {
  EXPECT_EQ(sign("1/3 - 0.3333333333333333333333333333"), CertainSign::kPositive);
  EXPECT_EQ(sign("-1e-1000"), CertainSign::kNegative);
  EXPECT_EQ(sign("0.1 + 0.2 - 0.3"), CertainSign::kZero);
}

TEST(CertainSign, OfOtherConstantsIsProved) {
  EXPECT_EQ(sign("sqrt(2)*(1 - 1e-14) - sqrt(2)"), CertainSign::kNegative);
  EXPECT_EQ(sign("exp(1e-200) - 1"), CertainSign::kPositive);
  EXPECT_EQ(sign("sqrt(sqrt(3)) - 3^(1/4) + 1e-300"), CertainSign::kPositive);
  EXPECT_EQ(sign("atan2(1, 2) + acos(0.3) - asin(0.9) - log(2) + abs(cos(3)) - tan(1/7) - 2"),
            CertainSign::kNegative);
  EXPECT_EQ(sign("pi - 3.1415926535897932384626433832795028841971693993751058209749446"),
            CertainSign::kNegative);
}

TEST(CertainSign, SeesZeroByAlgebraAlone) {
  EXPECT_EQ(sign("2*sqrt(2) - sqrt(2) - sqrt(2)"), CertainSign::kZero);
  EXPECT_EQ(sign("sqrt(2)*(sqrt(2) + 1) - 2 - sqrt(2)"), CertainSign::kZero);
  EXPECT_EQ(sign("sqrt(sqrt(2) + 1)*sqrt(sqrt(2) - 1) - 1"), CertainSign::kUnknown);
}

}  // namespace
}  // namespace regulus::detail
