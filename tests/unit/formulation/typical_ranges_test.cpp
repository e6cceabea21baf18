// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/typical_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/sign.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

struct Ends {
  double lo, hi;
  bool operator==(const Ends&) const = default;
};

Ends typical(const Range& range, VariableKind kind = VariableKind::kMotion) {
  const Variable v = with_typical_ranges({{"x", "1", kind, range}}).at(0);
  EXPECT_TRUE(GiNaC::is_a<GiNaC::numeric>(v.range.lo) && GiNaC::is_a<GiNaC::numeric>(v.range.hi));
  return {approx_value(v.range.lo).value(), approx_value(v.range.hi).value()};
}

Ends typical(double lo, double hi, VariableKind kind = VariableKind::kMotion) {
  return typical({exact_value(lo), exact_value(hi)}, kind);
}

TEST(TypicalRanges, ContainTheGivenOnesAndAreLittleWider) {
  test::RandomSource random(1999);
  for (int i = 0; i < 2000; ++i) {
    const double half = std::ldexp(random.between(1, 2), static_cast<int>(random.between(-40, 40)));
    const double middle = random.between(-1000, 1000) * half, lo = middle - half,
                 hi = middle + half;
    for (const auto& [kind, most] :
         {std::pair{VariableKind::kMotion, 1.25}, std::pair{VariableKind::kGeometry, 2.125}}) {
      const Ends x = typical(lo, hi, kind);
      EXPECT_LE(x.lo, lo + 1e-12 * half);
      EXPECT_GE(x.hi, hi - 1e-12 * half);
      EXPECT_LE(x.hi - x.lo, most * (hi - lo) * (1 + 1e-12));
    }
  }
}

TEST(TypicalRanges, AreSharedByRangesThatDifferLittle) {
  EXPECT_EQ(typical(-15, 15), typical(-14.99, 14.98));
  EXPECT_EQ(typical(45, 50), typical(45.01, 50.02));
  EXPECT_NE(typical(-15, 15), typical(-10, 10));
  EXPECT_EQ(typical(-0.041, 0.041, VariableKind::kGeometry),
            typical(-0.06, 0.06, VariableKind::kGeometry));
}

TEST(TypicalRanges, DependOnValuesNotOnExpressions) {
  const GiNaC::ex third = GiNaC::numeric(1, 3), angle = GiNaC::Pi / 12;
  EXPECT_EQ(typical({-third, third}), typical({-GiNaC::sqrt(third * third), third}));
  EXPECT_EQ(typical({-angle, angle}), typical(-0.2617993877991494, 0.2617993877991494));
}

TEST(TypicalRanges, OfAPointAreANumberNearIt) {
  EXPECT_EQ(typical(0, 0), (Ends{0, 0}));
  const Ends x = typical(47.3, 47.3);
  EXPECT_EQ(x.lo, x.hi);
  EXPECT_NEAR(x.lo, 47.3, 47.3 / 256);
}

TEST(TypicalRanges, KeepARangeWithoutAFiniteValue) {
  const GiNaC::ex huge = GiNaC::pow(GiNaC::numeric(10), 400);
  const Range before{-huge, huge};
  const Variable v = with_typical_ranges({{"x", "1", VariableKind::kMotion, before}}).at(0);
  EXPECT_TRUE(v.range.lo.is_equal(-huge) && v.range.hi.is_equal(huge));
}

}  // namespace
}  // namespace regulus::detail
