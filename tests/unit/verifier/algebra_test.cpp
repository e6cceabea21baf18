// SPDX-License-Identifier: GPL-3.0-or-later
// Exact algebra knows the relations between sines and cosines of parts of a turn.
#include "runtime/verifier/algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProducts = 1 << 16;

bool are_equal(const std::string& a, const std::string& b) {
  Graph graph;
  const Scope scope;
  return certain_equal(graph, parse(a, scope, graph), parse(b, scope, graph), kProducts);
}

/// "7/60*pi".
std::string part_of_pi(int sixtieths) { return "(" + std::to_string(sixtieths) + "/60*pi)"; }

TEST(ExactAlgebra, KnowsThatARotationByAnyPartOfATurnIsOne) {
  for (int k = -130; k <= 130; ++k) {
    const std::string angle = part_of_pi(k);
    EXPECT_TRUE(are_equal("cos" + angle + "^2 + sin" + angle + "^2", "1")) << angle;
  }
}

TEST(ExactAlgebra, AddsAnglesThatAreTwelfthsOrTenthsOfHalfATurn) {
  for (const int unit : {5, 6})
    for (int a = 0; a < 120; a += unit)
      for (int b = 0; b < 120; b += 3 * unit) {
        const std::string x = part_of_pi(a), y = part_of_pi(b), sum = part_of_pi(a + b);
        EXPECT_TRUE(are_equal("sin" + sum, "sin" + x + "*cos" + y + " + cos" + x + "*sin" + y))
            << a << " " << b;
        EXPECT_TRUE(are_equal("cos" + sum, "cos" + x + "*cos" + y + " - sin" + x + "*sin" + y))
            << a << " " << b;
      }
}

TEST(ExactAlgebra, KnowsTheRootsThatOtherProgramsWriteForThem) {
  EXPECT_TRUE(are_equal("cos(2/5*pi)", "1/4*sqrt(5) - 1/4"));
  EXPECT_TRUE(are_equal("cos(1/5*pi)", "1/4*sqrt(5) + 1/4"));
  EXPECT_TRUE(are_equal("sin(2/5*pi)", "1/4*sqrt(10 + 2*sqrt(5))"));
  EXPECT_TRUE(are_equal("sin(2/5*pi)*sin(1/5*pi)", "1/4*sqrt(5)"));
  EXPECT_TRUE(are_equal("sin(1/12*pi)", "1/4*sqrt(6) - 1/4*sqrt(2)"));
}

/// The oracle is the sine of the processor: what differs there is never called equal.
TEST(ExactAlgebra, DoesNotTakeDifferentNumbersForEqual) {
  const auto value = [](int k) { return std::sin(k / 60.0 * std::numbers::pi); };
  for (int a = 0; a < 120; a += 3)
    for (int b = 0; b < 120; b += 5) {
      const bool differ = std::abs(value(a) - value(b)) > 1e-9;
      EXPECT_NE(are_equal("sin" + part_of_pi(a), "sin" + part_of_pi(b)), differ) << a << " " << b;
    }
}

}  // namespace
}  // namespace regulus::verifier
