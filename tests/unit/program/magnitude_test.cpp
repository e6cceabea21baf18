// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/magnitude.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "codegen/kernel/program/enclose.hpp"

namespace regulus::detail {
namespace {

struct Bound {
  long exponent;
  bool needs_check;
};

Bound bound_of(const std::function<NodeId(ProgramBuilder&)>& expression) {
  ProgramBuilder builder({"x"}, {"k"});
  builder.output(expression(builder));
  const Program program = std::move(builder).finish();
  const Magnitudes m = bound_magnitudes(program, enclose_constant_nodes(program));
  const NodeId output = program.outputs[0];
  return {m.exponents[output], m.needs_check[output]};
}

TEST(Magnitude, StartsFromTheLimitsOfTheAbi) {
  EXPECT_EQ(bound_of([](auto& b) { return b.input(0); }).exponent, 64);
  EXPECT_EQ(bound_of([](auto& b) { return b.point(0); }).exponent, 128);
}

TEST(Magnitude, AddsExponentsOfFactors) {
  EXPECT_EQ(bound_of([](auto& b) { return b.multiply(b.input(0), b.point(0)); }).exponent, 192);
  EXPECT_EQ(bound_of([](auto& b) { return b.power(b.input(0), 3); }).exponent, 192);
}

TEST(Magnitude, AllowsASumOneMoreThanItsLargerTerm) {
  EXPECT_EQ(bound_of([](auto& b) { return b.add(b.input(0), b.point(0)); }).exponent, 129);
  EXPECT_EQ(bound_of([](auto& b) { return b.subtract(b.point(0), b.input(0)); }).exponent, 129);
}

TEST(Magnitude, LimitsGuardedOperations) {
  EXPECT_EQ(
      bound_of([](auto& b) { return b.divide(b.constant(1), b.power(b.input(0), 9)); }).exponent,
      128);
  EXPECT_EQ(bound_of([](auto& b) { return b.call(Op::kExp, b.power(b.input(0), 9)); }).exponent,
            128);
}

TEST(Magnitude, ChecksWhatCanPassTheSafeExponent) {
  EXPECT_FALSE(bound_of([](auto& b) { return b.power(b.input(0), 15); }).needs_check);
  EXPECT_TRUE(bound_of([](auto& b) { return b.power(b.input(0), 16); }).needs_check);
  EXPECT_FALSE(bound_of([](auto& b) { return b.power(b.point(0), 7); }).needs_check);
  EXPECT_TRUE(bound_of([](auto& b) { return b.power(b.point(0), 8); }).needs_check);
}

TEST(Magnitude, ChecksWhateverIsComputedFromACheckedValue) {
  EXPECT_TRUE(
      bound_of([](auto& b) { return b.add(b.power(b.input(0), 16), b.input(0)); }).needs_check);
  EXPECT_TRUE(
      bound_of([](auto& b) { return b.power(b.power(b.input(0), 16), 1 << 10); }).needs_check);
  EXPECT_FALSE(
      bound_of([](auto& b) { return b.call(Op::kSin, b.power(b.input(0), 16)); }).needs_check);
}

TEST(Magnitude, ChecksAConstantThatNoDoubleBounds) {
  EXPECT_TRUE(bound_of([](auto& b) { return b.power(b.constant(2), 1025); }).needs_check);
  EXPECT_FALSE(bound_of([](auto& b) { return b.power(b.constant(2), 999); }).needs_check);
}

TEST(Magnitude, DoesNotTrustSmallFactors) {
  EXPECT_EQ(
      bound_of([](auto& b) { return b.multiply(b.constant("1/1000000"), b.input(0)); }).exponent,
      64);
}

}  // namespace
}  // namespace regulus::detail
