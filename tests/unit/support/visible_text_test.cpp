// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/visible_text.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

TEST(VisibleText, IsTextThatATerminalShowsAsItIs) {
  for (const char* text : {"", "plain ASCII ~", "Förderarm ±0.1 mm", "机器人", "\xf0\x9f\xa4\x96"})
    EXPECT_EQ(visible(text), text);
}

TEST(VisibleText, ShowsControlCharactersByTheirBytes) {
  EXPECT_EQ(visible("a\x1b[31m\x7f"), "a\\x1b[31m\\x7f");
  EXPECT_EQ(visible("a\nb\tc"), "a\\x0ab\\x09c");
  EXPECT_EQ(visible("a\nb\tc", true), "a\nb\\x09c");
  EXPECT_EQ(visible("\xc2\x9b"), "\\xc2\\x9b");
  EXPECT_EQ(visible("\xe2\x80\xa8"), "\\xe2\\x80\\xa8");
}

TEST(VisibleText, ShowsWhatChangesTheDirectionOfWriting) {
  EXPECT_EQ(visible("gpj\xe2\x80\xae.exe"), "gpj\\xe2\\x80\\xae.exe");
  EXPECT_EQ(visible("\xe2\x81\xa6"), "\\xe2\\x81\\xa6");
  EXPECT_EQ(visible("\xd8\x9c"), "\\xd8\\x9c");
  EXPECT_EQ(visible("\xe2\x80\xa6 \xe2\x80\x90"), "\xe2\x80\xa6 \xe2\x80\x90") << "these do not";
}

TEST(VisibleText, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(visible("r\xff\xfe"), "r\\xff\\xfe");
  EXPECT_EQ(visible("\xc3"), "\\xc3");
  EXPECT_EQ(visible("\xc3("), "\\xc3(");
  EXPECT_EQ(visible("\x9b"), "\\x9b");
  EXPECT_EQ(visible("\xc0\x9b"), "\\xc0\\x9b") << "longer than its code needs";
  EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
}

}  // namespace
}  // namespace regulus::detail
