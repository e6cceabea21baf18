// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/command/emitted_text.hpp"

namespace regulus::detail::test {
namespace {

TEST(EmittedText, IsTheSameInTwentyProcesses) {
  expect_same_text("robot_2", "table5_30", "auto", 20);
  expect_same_text("robot_1", "T2_errors", "auto", 20);
  expect_same_text("planar_3rpr", "circle", "auto", 20);
  expect_same_text("robot_1", "T2_errors", "closed-form", 20);
}

}  // namespace
}  // namespace regulus::detail::test
