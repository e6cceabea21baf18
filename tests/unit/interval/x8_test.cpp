// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the eight-lane functions as generated code calls them: by name, in any rounding mode.
#include "runtime/interval/x8.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {
namespace {

struct alignas(64) Block {
  double bounds[32] = {};
};

/// Makes lanes i with [i/8, i/8 + 0.01] as ordinate and [1, 2] as abscissa.
Block ordinary_input() {
  Block in;
  for (int lane = 0; lane < 8; ++lane) {
    in.bounds[lane] = lane / 8.0;
    in.bounds[8 + lane] = lane / 8.0 + 0.01;
    in.bounds[16 + lane] = 1;
    in.bounds[24 + lane] = 2;
  }
  return in;
}

using Function = unsigned (*)(const double*, double*);

[[gnu::noinline]] unsigned call_with_mxcsr(unsigned mxcsr, Function f, const Block& in,
                                           Block& out) {
  const unsigned before = read_mxcsr();
  write_mxcsr(mxcsr);
  const unsigned undefined = f(in.bounds, out.bounds);
  const unsigned after = read_mxcsr();
  write_mxcsr(before);
  constexpr unsigned kFlags = 0x3f;
  EXPECT_EQ(after & ~kFlags, mxcsr & ~kFlags);
  return undefined;
}

TEST(X8, GivesTheSameBitsInEveryFloatingPointEnvironment) {
  constexpr unsigned kMasked = 0x1f80;
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  const auto table = regulus_x8_functions();
  const Block in = ordinary_input();
  for (unsigned i = 0; i < table.count; ++i) {
    Block nearest;
    const unsigned undefined = call_with_mxcsr(kMasked, table.functions[i].address, in, nearest);
    for (unsigned rounding = 0; rounding < 4; ++rounding) {
      for (const unsigned extra : {0u, kFlushToZero, kDenormalsAreZero}) {
        Block other;
        const unsigned mxcsr = kMasked | rounding << 13 | extra;
        EXPECT_EQ(call_with_mxcsr(mxcsr, table.functions[i].address, in, other), undefined);
        EXPECT_EQ(std::memcmp(&nearest, &other, sizeof other), 0)
            << table.functions[i].name << " with MXCSR " << std::hex << mxcsr;
      }
    }
  }
}

TEST(X8, DoesNotTrapWhenTheCallerUnmasksExceptions) {
  constexpr unsigned kInvalidUnmasked = 0x1f80 & ~0x0080u;
  Block in = ordinary_input();
  in.bounds[0] = in.bounds[8] = 0x1p400;  // this bound has no meaningful reduction
  Block out;
  EXPECT_EQ(call_with_mxcsr(kInvalidUnmasked, regulus_x8_sin, in, out), 0u);
  EXPECT_EQ(out.bounds[0], -1);
  EXPECT_EQ(out.bounds[8], 1);
}

TEST(X8, NamesEveryFunctionOnce) {
  const auto table = regulus_x8_functions();
  std::set<std::string> names;
  for (unsigned i = 0; i < table.count; ++i) names.insert(table.functions[i].name);
  EXPECT_EQ(names, (std::set<std::string>{"regulus_x8_sin", "regulus_x8_cos", "regulus_x8_sincos",
                                          "regulus_x8_tan", "regulus_x8_asin", "regulus_x8_acos",
                                          "regulus_x8_atan", "regulus_x8_atan2", "regulus_x8_exp",
                                          "regulus_x8_log"}));
  EXPECT_EQ(names.size(), table.count);
}

/// Computes the result of each function on the input above, one lane at a time.
TEST(X8, AgreesWithTheFunctionsOfOneInterval) {
  const Block in = ordinary_input();
  const auto same = [&](Function f, auto scalar, int result = 0) {
    Block out;
    const unsigned undefined = f(in.bounds, out.bounds);
    for (int lane = 0; lane < 8; ++lane) {
      const Interval x(in.bounds[lane], in.bounds[8 + lane]);
      const Interval y = scalar(x);
      const double* lo = out.bounds + 16 * result + lane;
      EXPECT_EQ((undefined >> lane & 1) != 0, !is_bounded(y));
      EXPECT_EQ(Interval(lo[0], lo[8]), is_bounded(y) ? y : Interval(0.0));
    }
  };
  same(regulus_x8_sin, [](Interval x) { return sin(x); });
  same(regulus_x8_cos, [](Interval x) { return cos(x); });
  same(
      regulus_x8_sincos, [](Interval x) { return sin(x); }, 0);
  same(
      regulus_x8_sincos, [](Interval x) { return cos(x); }, 1);
  same(regulus_x8_tan, [](Interval x) { return tan(x); });
  same(regulus_x8_asin, [](Interval x) { return asin(x); });
  same(regulus_x8_acos, [](Interval x) { return acos(x); });
  same(regulus_x8_atan, [](Interval x) { return atan(x); });
  same(regulus_x8_atan2, [](Interval y) { return atan2(y, Interval(1, 2)); });
  same(regulus_x8_exp, [](Interval x) { return exp(x); });
  same(regulus_x8_log, [](Interval x) { return log(x); });
}

TEST(X8, MarksMalformedAndExcessiveLanesAndLeavesTheOthers) {
  Block in = ordinary_input();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  in.bounds[1] = nan;                   // lane 1: lower bound
  in.bounds[8 + 2] = nan;               // lane 2: upper bound
  in.bounds[3] = in.bounds[8 + 3] + 1;  // lane 3: wrong order
  in.bounds[8 + 4] = 89;                // lane 4: e^89 > 2^128
  const auto table = regulus_x8_functions();
  for (unsigned i = 0; i < table.count; ++i) {
    Block out;
    const unsigned undefined = table.functions[i].address(in.bounds, out.bounds);
    EXPECT_EQ(undefined & 0b1110, 0b1110u) << table.functions[i].name;
    for (const double bound : out.bounds) EXPECT_TRUE(std::isfinite(bound));
  }
  Block out;
  EXPECT_EQ(regulus_x8_exp(in.bounds, out.bounds), 0b11110u);
  EXPECT_EQ(regulus_x8_sin(in.bounds, out.bounds), 0b01110u);
}

}  // namespace
}  // namespace regulus::detail
