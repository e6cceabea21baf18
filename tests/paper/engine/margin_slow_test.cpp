// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the distance between both ends of the bracket on robot 1.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;

const char* const kRobot1 = "models/robot_1.toml";
const char* const kUnscaled = "tests/paper/models/robot_1_unscaled.toml";

/// The search for the bracket ends by itself, in half a minute on a machine without other load.
json margin(const std::string& model, const std::string& motion,
            const std::vector<std::string>& question) {
  std::vector<std::string> words{REGULUS_BINARY_DIR "/bin/regulus", "margin",
                                 REGULUS_SOURCE_DIR "/" + model, motion};
  words.insert(words.end(), question.begin(), question.end());
  words.insert(words.end(), {"--json", "--quiet", "--time-limit", "300"});
  return json::parse(run_command(words).output);
}

double nearness(const json& report) {
  return report["certified"].get<double>() / report["refuted"].get<double>();
}

TEST(Margin, OfAnchorsIsKnownToATwentiethWithinFifteenDegrees) {
  const json report = margin(kRobot1, "wide_15", {"--tolerance", "base,platform=0:1"});
  EXPECT_LE(report["refuted"], 0.1345);
  EXPECT_GE(nearness(report), 0.98);
}

TEST(Margin, OfAnchorsIsKnownToATwentiethWithinFiveDegrees) {
  const json report = margin(kRobot1, "table4_5", {"--tolerance", "base,platform=0:1"});
  EXPECT_LE(report["refuted"], 0.236);
  EXPECT_GE(nearness(report), 0.96);
}

TEST(Margin, OfTheThresholdIsKnownToATwentieth) {
  EXPECT_GE(nearness(margin(kRobot1, "wide_15", {"--alpha", "0:"})), 0.95);
}

TEST(Margin, OfTheThresholdWithoutRowScalesIsKnownToATwentieth) {
  EXPECT_GE(nearness(margin(kUnscaled, "wide_15", {"--alpha", "0:"})), 0.95);
}

}  // namespace
}  // namespace regulus::detail::test
