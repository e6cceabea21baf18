// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/shell_word.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::test {
namespace {

TEST(AWordForAShell, IsQuotedIfAShellWouldChangeIt) {
  EXPECT_EQ(shell_word("models/robot_1.toml"), "models/robot_1.toml");
  EXPECT_EQ(shell_word("psi=-5*deg:5*deg"), "'psi=-5*deg:5*deg'");
  EXPECT_EQ(shell_word("my robot.toml"), "'my robot.toml'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(ACommandForAShell, HasItsWords) {
  const std::vector<std::string> words = {"regulus", "check", "it's a \"robot\".toml", "", "$(x)",
                                          "a\\b",    "x\ny"};
  EXPECT_EQ(words_of_command(shell_command(words)), words);
}

}  // namespace
}  // namespace regulus::detail::test
