// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/names.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

TEST(IdentifierPart, KeepsLettersDigitsAndSingleUnderscores) {
  EXPECT_EQ(identifier_part("psi_2"), "psi_2");
  EXPECT_EQ(identifier_part("X"), "X");
}

TEST(IdentifierPart, LeavesNothingThatEndsAnIdentifier) {
  for (const char* name : {"a b", "x;int y", "x\"", "x\n#include", "x*/", "x//", "é", "a.b", "(",
                           "\\", "", "_", "a__b", "x\0y"}) {
    EXPECT_TRUE(is_identifier("v_" + identifier_part(name))) << name;
    EXPECT_EQ(identifier_part(name).find("__"), std::string::npos) << name;
    EXPECT_NE(identifier_part(name).back(), '_') << name;
  }
}

TEST(IsIdentifier, RefusesEverythingElse) {
  EXPECT_TRUE(is_identifier("robot_1"));
  for (const char* text : {"", "1a", "a-b", "a b", "a\n", "ä"}) EXPECT_FALSE(is_identifier(text));
}

TEST(NameTable, NeverGivesANameTwice) {
  NameTable table;
  EXPECT_EQ(table.take("v_a_b"), "v_a_b");
  EXPECT_EQ(table.take("v_a_b"), "v_a_b_2");
  EXPECT_EQ(table.take("v_a_b_2"), "v_a_b_2_2");
  EXPECT_EQ(table.take("v_a_b"), "v_a_b_3");
}

}  // namespace
}  // namespace regulus::detail
