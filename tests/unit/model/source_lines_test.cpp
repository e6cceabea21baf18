// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/source_lines.hpp"

#include <gtest/gtest.h>

#include <string>

namespace regulus::detail {
namespace {

TEST(SourceLines, CountCharactersAndNotBytes) {
  const std::string text = "ab\n\u00e4\u2126\U0001F916z\n";
  const SourceLines lines(text);
  EXPECT_EQ(lines.offset(1, 1), 0U);
  EXPECT_EQ(lines.offset(1, 3), 2U);  // the end of the line
  EXPECT_EQ(lines.offset(2, 1), 3U);
  EXPECT_EQ(lines.offset(2, 2), 5U);
  EXPECT_EQ(lines.offset(2, 4), text.find('z'));
  EXPECT_EQ(lines.offset(3, 1), text.size());
}

TEST(SourceLines, DoNotCountAByteOrderMark) {
  const SourceLines lines("\xEF\xBB\xBFx = 1\r\ny = 2");
  EXPECT_EQ(lines.offset(1, 1), 3U);
  EXPECT_EQ(lines.offset(1, 5), 7U);
  EXPECT_EQ(lines.offset(2, 1), 10U);
}

TEST(SourceLines, EndWhereTheTextEnds) {
  const SourceLines lines("x");
  for (const std::size_t far : {2U, 3U, 1000000U}) {
    EXPECT_EQ(lines.offset(1, far), 1U);
    EXPECT_EQ(lines.offset(far, 1), 1U);
  }
  EXPECT_EQ(lines.offset(0, 1), 1U);
  EXPECT_EQ(SourceLines("").offset(1, 1), 0U);
}

TEST(SourceLines, FindPlacesOnLongLines) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += i % 3 == 0 ? "\u00b5" : "a";
  const SourceLines lines(text);
  std::size_t at = 0;
  for (std::size_t column = 1; column <= 1000; ++column) {
    EXPECT_EQ(lines.offset(1, column), at);
    at += (column - 1) % 3 == 0 ? 2 : 1;
  }
}

}  // namespace
}  // namespace regulus::detail
