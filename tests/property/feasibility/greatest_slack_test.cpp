// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the small linear program that proposes forces.
#include "codegen/question/load/greatest_slack.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace regulus::detail::test {
namespace {

TEST(GreatestSlack, IsTheLeastBoundWhereNothingCanBeMoved) {
  // A null space whose rows are all 0, as of rows whose forces are given: an equation without
  // coefficients.
  for (const std::size_t dimension : {0U, 1U, 2U}) {
    const std::vector<double> normals(3 * dimension, 0.0), bounds{2.0, 1.0, 3.0};
    const auto found = approx_greatest_slack(normals, dimension, bounds);
    ASSERT_TRUE(found) << dimension;
    EXPECT_NEAR(found->s, 1.0, 1e-12) << dimension;
    EXPECT_EQ(found->z.size(), dimension);
    ASSERT_EQ(found->multipliers.size(), 3U);
    EXPECT_NEAR(std::accumulate(found->multipliers.begin(), found->multipliers.end(), 0.0), 1.0,
                1e-12)
        << dimension;
  }
}

TEST(GreatestSlack, LiesInTheMiddleOfAnInterval) {
  // z + s <= 4 and -z + s <= 2, with a second unknown that no row has.
  const auto found =
      approx_greatest_slack(std::vector<double>{1, 0, -1, 0}, 2, std::vector<double>{4, 2});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->s, 3.0, 1e-12);
  EXPECT_NEAR(found->z[0], 1.0, 1e-12);
  EXPECT_NEAR(found->multipliers[0], 0.5, 1e-12);
  EXPECT_NEAR(found->multipliers[1], 0.5, 1e-12);
}

}  // namespace
}  // namespace regulus::detail::test
