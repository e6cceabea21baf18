// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/comment.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

TEST(CommentText, KeepsWhatFormulasAreWrittenWith) {
  const std::string formula = "∂(K·A)[0][1]/∂ψ, §III-B1 form 2: J⁻¹ ≤ α – é";
  EXPECT_EQ(comment_text(formula), formula);
}

TEST(CommentText, ReplacesWhatCouldLeaveTheLine) {
  EXPECT_EQ(comment_text("a\nb"), "a?b");
  EXPECT_EQ(comment_text("a\r\vb\f\x85"), "a??b??");
  EXPECT_EQ(comment_text("end\\"), "end?");
  EXPECT_EQ(comment_text(std::string_view("a\0b", 3)), "a?b");
}

TEST(CommentText, PullsCommentMarksApart) {
  EXPECT_EQ(comment_text("a */ b /* c"), "a * / b / * c");
  EXPECT_EQ(comment_text("\?\?/"), "? ?/");
  EXPECT_EQ(comment_text("*/*"), "* / *");
}

TEST(CommentText, ReplacesCharactersThatHideOrReorder) {
  EXPECT_EQ(comment_text("a\u202Eb"), "a?b");
  EXPECT_EQ(comment_text("a\u2066b"), "a?b");
  EXPECT_EQ(comment_text("a\u200Bb"), "a?b");
  EXPECT_EQ(comment_text("a\u2028b"), "a?b");
  EXPECT_EQ(comment_text("a\uFEFFb"), "a?b");
}

TEST(CommentText, ReplacesInvalidUtf8) {
  EXPECT_EQ(comment_text("\xC3"), "?");
  EXPECT_EQ(comment_text("\xC0\x8A"), "??");       // an overlong newline
  EXPECT_EQ(comment_text("\xE0\x80\x8A"), "???");  // another
  EXPECT_EQ(comment_text("\xED\xA0\x80"), "?");    // a surrogate
  EXPECT_EQ(comment_text("\xFF\xFE"), "??");
}

TEST(CommentLines, StayCommentsWhateverTheBytes) {
  test::RandomSource random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    constexpr std::string_view kNasty = "\n\r\\*/?\"' #\t\x80\xE2\xAE\xC2";
    for (std::uint64_t n = random.below(300); n > 0; --n)
      bytes += random.one_in(2) ? kNasty[random.below(kNasty.size())]
                                : static_cast<char>(random.below(256));
    std::istringstream lines(comment_lines("  ", bytes));
    for (std::string line; std::getline(lines, line);) {
      ASSERT_TRUE(line.starts_with("  //")) << line;
      ASSERT_EQ(line.find_first_of("\\\r\v\f"), std::string::npos) << line;
    }
  }
}

TEST(CommentLines, WrapAtWords) {
  const std::string long_text = [] {
    std::string text;
    for (int i = 0; i < 60; ++i) text += "word ";
    return text;
  }();
  std::istringstream lines(comment_lines("", long_text));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100U);
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace regulus::detail
