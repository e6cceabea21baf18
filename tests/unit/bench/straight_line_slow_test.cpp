// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/kernel/straight_line.hpp"

namespace regulus::detail::bench {
namespace {

using ::testing::HasSubstr;

TEST(StraightLineText, HasEveryOperationOnceInTheProgramsOrder) {
  ProgramBuilder builder({"x", "phi"}, {"k_1_1"});
  const auto product = builder.multiply(builder.point(0), builder.input(0));
  builder.output(builder.subtract(product, builder.call(Op::kSin, builder.input(1))));
  builder.output(product);
  const std::string text = straight_line_text(std::move(builder).finish(), "f");
  EXPECT_THAT(text, HasSubstr("void f(A& a, const typename A::Number* v, const double* k,"));
  EXPECT_THAT(text, HasSubstr("= a.multiply(k[0], v[0]);"));
  EXPECT_EQ(text.find("a.multiply"), text.rfind("a.multiply"));
  EXPECT_THAT(text, HasSubstr("= a.sin(v[1]);"));
  EXPECT_LT(text.find("a.multiply"), text.find("a.subtract"));
}

TEST(StraightLineText, WritesExactDoublesAsSuchAndOtherConstantsByTwoBounds) {
  ProgramBuilder builder({"x"}, {});
  builder.output(builder.add(builder.input(0), builder.constant(cln::cl_RA("3/4"))));
  builder.output(builder.multiply(builder.input(0), builder.constant(cln::cl_RA("1/3"))));
  const std::string text = straight_line_text(std::move(builder).finish(), "f");
  EXPECT_THAT(text, HasSubstr("0x1.8p-1"));
  EXPECT_THAT(text, HasSubstr("a.constant(0x1.5555555555555p-2, 0x1.5555555555556p-2)"));
}

TEST(StraightLineText, RefusesAnOperationThatNotEveryArithmeticHas) {
  ProgramBuilder builder({"x"}, {});
  builder.output(builder.call(Op::kExp, builder.input(0)));
  const auto program = std::move(builder).finish();
  EXPECT_THROW(static_cast<void>(straight_line_text(program, "f")), std::invalid_argument);
}

}  // namespace
}  // namespace regulus::detail::bench
