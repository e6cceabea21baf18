// SPDX-License-Identifier: GPL-3.0-or-later
// How near both ends of the bracket come on robot 1.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/command.hpp"

namespace regulus::test {
namespace {

using nlohmann::json;

json margin(const std::string& motion, const std::vector<std::string>& question) {
  std::vector<std::string> words{REGULUS_BINARY_DIR "/bin/regulus", "margin",
                                 REGULUS_SOURCE_DIR "/models/robot_1.toml", motion};
  words.insert(words.end(), question.begin(), question.end());
  words.insert(words.end(), {"--json", "--quiet", "--time-limit", "60"});
  return json::parse(run_command(words).output);
}

double nearness(const json& report) {
  return report["certified"].get<double>() / report["refuted"].get<double>();
}

TEST(Margin, OfAnchorsIsKnownToATenthWithinFifteenDegrees) {
  const json report = margin("wide_15", {"--tolerance", "base,platform=0:1"});
  EXPECT_LE(report["refuted"], 0.1345);
  EXPECT_GE(nearness(report), 0.90);
}

TEST(Margin, OfAnchorsIsKnownToAFifthWithinFiveDegrees) {
  const json report = margin("table4_5", {"--tolerance", "base,platform=0:1"});
  EXPECT_LE(report["refuted"], 0.236);
  EXPECT_GE(nearness(report), 0.80);
}

TEST(Margin, OfTheThresholdIsKnownToATwentieth) {
  EXPECT_GE(nearness(margin("wide_15", {"--alpha", "0:"})), 0.95);
}

}  // namespace
}  // namespace regulus::test
