// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

TEST(QuotedText, ShowsLettersOfAnyAlphabetAsTheyAre) { EXPECT_EQ(in_quotes("hälf"), "'hälf'"); }

TEST(QuotedText, HasNoControlCharacter) { EXPECT_EQ(in_quotes("a\x1b[31m"), "'a\\x1b[31m'"); }

TEST(QuotedText, EndsWithAWholeCharacter) {
  for (const std::size_t first : {std::size_t(0), std::size_t(1)}) {
    std::string text(first, 'a');
    for (int i = 0; i < 200; ++i) text += "ü";
    const std::string quoted = in_quotes(text);
    EXPECT_EQ(quoted.find('\\'), std::string::npos) << quoted;
    EXPECT_TRUE(quoted.ends_with("ü…'")) << quoted;
  }
}

TEST(QuotedText, IsCutBetweenCharacters) {
  EXPECT_EQ(first_bytes("aü", 2), "a");
  EXPECT_EQ(first_bytes("aü", 3), "aü");
  EXPECT_EQ(first_bytes("ü", 1), "");
}

}  // namespace
}  // namespace regulus::detail
