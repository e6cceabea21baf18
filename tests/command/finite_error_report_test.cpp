// SPDX-License-Identifier: GPL-3.0-or-later
// The report tells a person the finite errors of a platform on legs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The equations have a deviation of each leg's length, which every motion leaves at 0.
TEST(FiniteErrorReport, NamesThePoseAndNoLegsOfLength0) {
  const CommandResult result =
      regulus({"bound", model_path("octahedral"), "level_89", "error", "--finite", "--tolerance",
               "base=0.001", "--freedom", "z_deviation", "--range", "x=0", "--range", "y=0",
               "--range", "z=10", "--range", "yaw=0.3"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("finite error"));
  EXPECT_THAT(result.errors, HasSubstr("\n           z = 10 cm"));
  EXPECT_THAT(result.errors, Not(HasSubstr("leg_1 = 0")));
}

}  // namespace
}  // namespace regulus::detail::test
