// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/bench/report/writers.hpp"

namespace regulus::detail::bench {
namespace {

using ::testing::HasSubstr;

Report example() {
  Row faster;
  faster.name = "theirs";
  faster.value = 1234.5;
  faster.unit = "ns";
  faster.ratio = Spread{21.5, 20.5, 23};
  faster.target = ratio_at_least(20);
  faster.explanation = "what they do";
  Row larger;
  larger.name = "memory";
  larger.value = 300;
  larger.unit = "MB";
  larger.target = value_at_most(250);
  return {{"a processor", 2, 0.5, "a compiler", "another"},
          {{"kernel", "Kernels", "A note.", {faster, skipped_row("absent", "no library", "why")}},
           {"process", "Processes", "", {larger}}}};
}

TEST(Report, MeetsATargetAtTheBoundItself) {
  Row row;
  row.value = 40;
  row.target = value_at_least(40);
  EXPECT_EQ(met(row), true);
  row.target = value_at_most(39.9);
  EXPECT_EQ(met(row), false);
  row.target = ratio_at_most(3);
  EXPECT_EQ(met(row), std::nullopt) << "there is no ratio to compare";
}

TEST(Report, CountsTargetsOfMeasuredRowsOnly) {
  EXPECT_EQ(summary(example()), "1 of 2 targets met");
}

TEST(Json, HasEveryFieldOfEveryRow) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["machine"]["processor"], "a processor");
  EXPECT_EQ(json["machine"]["compiler"], "a compiler");
  ASSERT_EQ(json["rows"].size(), 3U);
  const auto& row = json["rows"][0];
  EXPECT_EQ(row["section"], "kernel");
  EXPECT_EQ(row["name"], "theirs");
  EXPECT_EQ(row["value"], 1234.5);
  EXPECT_EQ(row["unit"], "ns");
  EXPECT_EQ(row["ratio"], 21.5);
  EXPECT_EQ(row["ratio_quartiles"], (nlohmann::json{20.5, 23.0}));
  EXPECT_EQ(row["target"], (nlohmann::json{{"of", "ratio"}, {"at_least", 20.0}}));
  EXPECT_EQ(row["met"], true);
  EXPECT_EQ(row["explanation"], "what they do");
  EXPECT_TRUE(row["skipped"].is_null());
  EXPECT_EQ(json["rows"][2]["met"], false);
}

TEST(Json, SaysNullAndWhyForASkippedRow) {
  const auto row = nlohmann::json::parse(to_json(example()))["rows"][1];
  EXPECT_TRUE(row["value"].is_null());
  EXPECT_TRUE(row["met"].is_null());
  EXPECT_EQ(row["skipped"], "no library");
}

TEST(Markdown, HasALineForEveryRow) {
  const std::string text = to_markdown(example());
  EXPECT_THAT(text, HasSubstr("a processor, 2 processors, which 0.5 other programs"));
  EXPECT_THAT(
      text,
      HasSubstr("| theirs | 1230 ns | 21.5 (20.5–23.0) | ratio ≥ 20.0 | yes | what they do |"));
  EXPECT_THAT(text, HasSubstr("| absent | skipped: no library |  |  |  | why |"));
  EXPECT_THAT(text, HasSubstr("| memory | 300 MB |  | value ≤ 250 | **no** |  |"));
}

}  // namespace
}  // namespace regulus::detail::bench
