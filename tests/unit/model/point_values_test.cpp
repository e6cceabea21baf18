// SPDX-License-Identifier: GPL-3.0-or-later
// Values at a point against GiNaC's own.
#include "codegen/model/exact/point_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace regulus::detail::point_values_test {
namespace {

using GiNaC::ex;

const GiNaC::symbol x("x"), y("y"), unknown("unknown");

TEST(PointValues, AreThoseOfGiNaC) {
  const ex root = GiNaC::sqrt(x * x + y + 3);
  const std::vector<ex> expressions = {
      ex(7) / 3,
      GiNaC::Pi / 2,
      x - 2 * y,
      x * y / (x + 5),
      GiNaC::pow(x, 7) - GiNaC::pow(y, -3),
      root * GiNaC::pow(root + 1, ex(-3) / 2) + root,
      GiNaC::sin(x) + GiNaC::cos(x * y) - GiNaC::tan(y / 3),
      GiNaC::asin(x / 4) + GiNaC::acos(y / 4) + GiNaC::atan(root),
      GiNaC::atan2(y, -x) + GiNaC::exp(-x) + GiNaC::log(root) + GiNaC::abs(x - 9)};
  for (const double at : {-2.25, -0.5, 0.125, 1.5})
    for (const double other : {-1.75, 0.75, 2.0}) {
      const GiNaC::exmap point{{x, at}, {y, other}};
      PointValues values(point);
      for (const ex& e : expressions) {
        const double expected = approx_number(e.subs(point));
        const double found = values.of(e);
        if (std::isnan(expected)) {
          EXPECT_TRUE(std::isnan(found)) << e << " is " << found;
        } else {
          EXPECT_NEAR(found, expected, 1e-13 * (1 + std::abs(expected))) << e;
        }
      }
    }
}

TEST(PointValues, AreNoNumbersWhereThereIsNone) {
  PointValues values({{x, ex(-2)}, {y, ex(0)}});
  for (const ex& e :
       std::vector<ex>{unknown, x + unknown, GiNaC::sqrt(x), GiNaC::log(x), GiNaC::asin(x)})
    EXPECT_TRUE(std::isnan(values.of(e))) << e;
  EXPECT_FALSE(std::isfinite(values.of(1 / y)));
}

}  // namespace
}  // namespace regulus::detail::point_values_test
