// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/import/loop_robots.hpp"

namespace regulus::detail::test {
namespace {

TEST_P(LoopRobots, AreTheKinematicsOfTheirFilesForAMillionDrives) {
  expect_robot(GetParam(), 1'000'000);
}

INSTANTIATE_TEST_SUITE_P(Published, LoopRobots, testing::ValuesIn(kLoopRobots), name_of);

}  // namespace
}  // namespace regulus::detail::test
