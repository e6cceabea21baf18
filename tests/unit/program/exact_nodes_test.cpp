// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/exact_nodes.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "codegen/kernel/program/enclose.hpp"

namespace regulus::detail {
namespace {

using Expression = std::function<NodeId(ProgramBuilder&)>;

/// Returns whether the expression is exact. K is 2×2: points 0, 1 are one row, 2, 3 the other.
bool is_exact(const Expression& expression, std::size_t row_length = 2) {
  ProgramBuilder builder({"x"}, {"k_1_1", "k_1_2", "k_2_1", "k_2_2"});
  builder.output(expression(builder));
  const Program program = std::move(builder).finish();
  return exact_nodes(program, enclose_constant_nodes(program), row_length)[program.outputs[0]];
}

NodeId times(ProgramBuilder& b, const cln::cl_RA& factor, unsigned point) {
  return b.multiply(b.constant(factor), b.point(point));
}

TEST(ExactNodes, AreSumsOfOneRowWithShortCoefficients) {
  EXPECT_TRUE(is_exact([](auto& b) { return b.point(3); }));
  EXPECT_TRUE(is_exact([](auto& b) { return b.add(b.point(0), b.point(1)); }));
  EXPECT_TRUE(is_exact([](auto& b) { return b.subtract(times(b, 78, 0), times(b, -63, 1)); }));
  EXPECT_TRUE(is_exact([](auto& b) { return b.add(times(b, cln::cl_RA(3) / 8, 2), b.point(3)); }));
}

TEST(ExactNodes, HaveNoEntriesOfTwoRows) {
  EXPECT_FALSE(is_exact([](auto& b) { return b.add(b.point(1), b.point(2)); }));
  EXPECT_TRUE(is_exact([](auto& b) { return b.add(b.point(1), b.point(2)); }, 4));
}

TEST(ExactNodes, HaveNoCoefficientThatIsNoDouble) {
  EXPECT_FALSE(is_exact([](auto& b) { return times(b, cln::cl_RA(1) / 10, 0); }));
  EXPECT_FALSE(is_exact([](auto& b) { return b.multiply(b.pi(), b.point(0)); }));
}

TEST(ExactNodes, HaveNoVariableConstantTermOrSquare) {
  EXPECT_FALSE(is_exact([](auto& b) { return b.multiply(b.input(0), b.point(0)); }));
  EXPECT_FALSE(is_exact([](auto& b) { return b.add(b.constant(1), b.point(0)); }));
  EXPECT_FALSE(is_exact([](auto& b) { return b.multiply(b.point(0), b.point(1)); }));
  EXPECT_FALSE(is_exact([](auto& b) { return b.power(b.point(0), 2); }));
}

TEST(ExactNodes, EndWhereFiftyThreeBitsDo) {
  const auto power = [](int n) { return cln::expt(cln::cl_RA(2), n); };
  // 29 bits plus 24 bits give 53.
  EXPECT_TRUE(is_exact([&](auto& b) { return times(b, power(24) - 1, 0); }));
  EXPECT_TRUE(is_exact([&](auto& b) { return times(b, power(24), 0); }));
  EXPECT_FALSE(is_exact([&](auto& b) { return times(b, power(24) + 1, 0); }));
  EXPECT_FALSE(is_exact([&](auto& b) { return b.add(times(b, power(24), 0), b.point(1)); }));
  // With a common factor, one entry has other powers of two than the rest.
  EXPECT_FALSE(is_exact([&](auto& b) { return b.add(times(b, power(-25), 0), b.point(1)); }));
  EXPECT_TRUE(is_exact([&](auto& b) { return b.add(times(b, power(-23), 0), b.point(1)); }));
  EXPECT_FALSE(is_exact([&](auto& b) { return times(b, power(-200), 0); }));
}

TEST(ExactNodes, AreNoneWhenNothingIsKnownOfTheRows) {
  EXPECT_FALSE(is_exact([](auto& b) { return b.add(b.point(0), b.point(1)); }, 0));
}

}  // namespace
}  // namespace regulus::detail
