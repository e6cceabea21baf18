// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that text for a terminal is broken at blanks, below the place where it begins.
#include "codegen/support/wrapped_text.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::test {
namespace {

TEST(WrappedReport, GoesOnBelowTheSentence) {
  EXPECT_EQ(wrapped_report("meaning    at no pose of this motion does it happen\nSAFE\n", 41),
            "meaning    at no pose of this motion does\n"
            "           it happen\nSAFE\n");
}

TEST(WrappedReport, CountsCharactersAndNotBytes) {
  const std::string line = "uncertain  ±0.05 cm ±0.05 cm ±0.05 cm\n";
  EXPECT_EQ(wrapped_report(line, 37), line);
  EXPECT_EQ(wrapped_report(line, 36),
            "uncertain  ±0.05 cm ±0.05 cm ±0.05\n"
            "           cm\n");
}

TEST(WrappedReport, KeepsWhatFitsAndWordsThatAreTooLong) {
  const std::string fits = "at 0.1:  it   is proved\n\n  a map  .\n";
  EXPECT_EQ(wrapped_report(fits, 80), fits);
  const std::string file = "file       /a/path/that/is/longer/than/the/terminal/is/wide.toml\n";
  EXPECT_EQ(wrapped_report(file, 40), file);
}

TEST(WrappedTable, GoesOnBelowTheSecondColumn) {
  EXPECT_EQ(wrapped_table("Exit: 0 as the verdict, 64 usage, 65\n"
                          "  SAFE     it is proved at this value   (exit 0)\n",
                          36),
            "Exit: 0 as the verdict, 64 usage, 65\n"
            "  SAFE     it is proved at this\n"
            "           value   (exit 0)\n");
}

TEST(WrappedText, BeginsEachLineInItsColumn) {
  EXPECT_EQ(wrapped("one two three four five six seven", 34, 10),
            "one two three four five\n          six seven");
  EXPECT_EQ(wrapped("one\n  by hand, however long this line is, it stays", 34, 10),
            "one\n            by hand, however long this line is, it stays");
}

}  // namespace
}  // namespace regulus::detail::test
