// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/exact_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace regulus::detail {
namespace {

using GiNaC::cos, GiNaC::sin, GiNaC::sqrt, GiNaC::ex;

ex sixtieths_of_pi(int n) { return GiNaC::numeric(n, 60) * GiNaC::Pi; }

TEST(ExactAlgebraOfModels, KnowsThatARotationByAnyPartOfATurnIsOne) {
  for (int n = -130; n <= 130; ++n) {
    const ex angle = sixtieths_of_pi(n);
    EXPECT_TRUE(is_certainly_zero(pow(cos(angle), 2) + pow(sin(angle), 2) - 1)) << n;
  }
}

TEST(ExactAlgebraOfModels, AddsAnglesThatAreTwelfthsOrTenthsOfHalfATurn) {
  for (const int unit : {5, 6})
    for (int a = 0; a < 120; a += unit)
      for (int b = 0; b < 120; b += 3 * unit) {
        const ex x = sixtieths_of_pi(a), y = sixtieths_of_pi(b);
        EXPECT_TRUE(is_certainly_zero(sin(x) * cos(y) + cos(x) * sin(y) - sin(x + y)))
            << a << " " << b;
        EXPECT_TRUE(is_certainly_zero(cos(x) * cos(y) - sin(x) * sin(y) - cos(x + y)))
            << a << " " << b;
      }
}

TEST(ExactAlgebraOfModels, KeepsTheValue) {
  for (int n = 0; n < 120; ++n)
    for (int power = 1; power < 5; ++power) {
      const ex value = reduced(pow(sin(sixtieths_of_pi(n)), power)).evalf();
      EXPECT_NEAR(GiNaC::ex_to<GiNaC::numeric>(value).to_double(),
                  std::pow(std::sin(n / 60.0 * std::numbers::pi), power), 1e-12)
          << n << " " << power;
    }
}

}  // namespace
}  // namespace regulus::detail
