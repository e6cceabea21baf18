// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/import/links.hpp"

#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

TEST(RandomClosures, AreTheKinematicsOfTheirFiles) {
  Compared result;
  expect_closures(1, trials(25, 100), 3, result);
  EXPECT_GT(result.robots, trials(16, 70));
  EXPECT_GT(result.drives, trials(40, 180));
}

/// The oracle's screws against its own differences.
TEST(RandomClosures, HaveTheScrewsOfTheirDifferences) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const FileRobot robot = RandomLoops(seed).robot();
    Configuration at = robot.at_zero();
    if (robot.close(at, robot.passive(), 200, 1e-3) > 1e-12) continue;
    const Dense one = robot.screws(at, robot.passive()),
                other = robot.differences(at, robot.passive());
    for (std::size_t i = 0; i < one.a.size(); ++i) EXPECT_NEAR(one.a[i], other.a[i], 1e-7) << seed;
  }
}

}  // namespace
}  // namespace regulus::detail::test
