// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/manual/page.hpp"

namespace regulus::detail::test {
namespace {

TEST(WhatAPageShows, AgreesToThreeDigitsAndNoFewer) {
  EXPECT_TRUE(agrees({"x in [-15, 2.5e-3] cm"}, {"x in [-15, 2.5001e-3] cm"}));
  EXPECT_FALSE(agrees({"x in [-15, 2.5e-3] cm"}, {"x in [-15, 2.6e-3] cm"}));
  EXPECT_FALSE(agrees({"boxes 5"}, {"boxes 7"}));
  EXPECT_FALSE(agrees({"1 cm"}, {"1 rad"}));
  EXPECT_FALSE(agrees({"NO SINGULARITY"}, {"SINGULARITY"}));
}

TEST(WhatAPageShows, AgreesWhateverInstructionsTheProcessorHas) {
  EXPECT_TRUE(agrees({"method     auto, compiled for avx512, cache hit"},
                     {"method     auto, compiled for portable, cache hit"}));
  EXPECT_FALSE(agrees({"method     auto, compiled for avx512, cache hit"},
                      {"method     auto, compiled for avx512, cache miss"}));
}

TEST(WhatAPageShows, LeavesOutWhatItSaysItDoes) {
  EXPECT_TRUE(agrees({"a", "...", "z"}, {"a", "b", "c", "z"}));
  EXPECT_TRUE(agrees({"a", "...", "z"}, {"a", "z"}));
  EXPECT_FALSE(agrees({"a", "...", "z"}, {"a", "z", "y"}));
  EXPECT_TRUE(agrees({"took … ms"}, {"took 12 ms"}));
  EXPECT_FALSE(agrees({"took … ms"}, {"took 12 s"}));
  EXPECT_TRUE(agrees({"up to 0.21…, not"}, {"up to 0.2165, not"}));
  EXPECT_FALSE(agrees({"up to 0.21…, not"}, {"up to 0.2265, not"}));
  EXPECT_FALSE(agrees({"up to 0.21…, not"}, {"up to 0.2165 not"}));
  EXPECT_FALSE(agrees({"1…1"}, {"1"}));
  EXPECT_TRUE(agrees({"time  1 ms"}, {"time  20 ms, all of it"}));
  EXPECT_FALSE(agrees({"a"}, {"a", "b"}));
  EXPECT_FALSE(agrees({"a", "b"}, {"a"}));
}

TEST(APage, HasFilesExcerptsAndCommandsInTheirOrder) {
  const Page page{{"text", "```toml file=a.toml", "x = 1", "```", "```console", "$ one \\", "two",
                   "printed", "$ three", "```"}};
  const auto blocks = page.blocks();
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].value, "a.toml");
  const auto steps = steps_of(blocks[1]);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].command, "one \\\ntwo");
  EXPECT_EQ(steps[0].output, std::vector<std::string>{"printed"});
  EXPECT_EQ(page.lines[steps[0].first_line], "printed");
  EXPECT_EQ(steps[1].command, "three");
}

}  // namespace
}  // namespace regulus::detail::test
