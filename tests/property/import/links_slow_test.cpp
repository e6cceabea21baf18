// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/import/links.hpp"

namespace regulus::detail::test {
namespace {

TEST(RandomClosures, AreTheKinematicsOfManyFiles) {
  Compared result;
  expect_closures(100'000, 5000, 8, result);
  EXPECT_GT(result.robots, 3500);
  EXPECT_GT(result.drives, 20'000);
}

}  // namespace
}  // namespace regulus::detail::test
