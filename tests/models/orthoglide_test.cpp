// SPDX-License-Identifier: GPL-3.0-or-later
// The Orthoglide's published property: over its cube the platform's velocity is between 1/2 and 2
// times that of the motors, and no larger cube has it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

constexpr const char* kOrthoglide = REGULUS_SOURCE_DIR "/models/orthoglide.toml";

CommandResult bound(const std::string& quantity, const std::string& limit, double size) {
  // The cube about the middle of the published one, with `size` times its edge.
  const double middle = (std::sqrt(2.0) / 6 - 1 / std::sqrt(6.0)) / 2;
  const double half = size * (std::sqrt(2.0) / 6 + 1 / std::sqrt(6.0)) / 2;
  std::vector<std::string> words{REGULUS_BINARY_DIR "/bin/regulus",
                                 "bound",
                                 kOrthoglide,
                                 "cube",
                                 quantity,
                                 "--limit",
                                 limit,
                                 "--quiet"};
  for (const char* axis : {"x", "y", "z"}) {
    words.emplace_back("--range");
    words.push_back(std::string(axis) + "=" + std::to_string(middle - half) + ":" +
                    std::to_string(middle + half));
  }
  return run_command(words);
}

TEST(Orthoglide, HasItsVelocityFactorsOverItsCubeAndNoLargerOne) {
  EXPECT_EQ(bound("sigma-max", "2", 0.9999).output, "WITHIN\n");
  EXPECT_EQ(bound("sigma-min", "1/2", 0.9999).output, "WITHIN\n");
  EXPECT_EQ(bound("sigma-max", "2", 1.0001).output, "EXCEEDED\n");
  EXPECT_EQ(bound("sigma-min", "1/2", 1.0001).output, "EXCEEDED\n");
}

/// Expects that the bracket of the edge is as narrow as 1e-6, around `edge`.
void expect_largest_edge(const std::string& motion, const std::string& quantity,
                         const std::string& limit, double edge) {
  const CommandResult result = run_command(
      {REGULUS_BINARY_DIR "/bin/regulus", "margin", kOrthoglide, motion, "--grow", "edge=0.5:0.81",
       "--quantity", quantity, "--limit", limit, "--gap", "1e-6", "--json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto report = nlohmann::json::parse(result.output);
  EXPECT_LE(report["certified"], edge);
  EXPECT_GE(report["refuted"], edge);
  EXPECT_LE(report["gap"], 1e-6);
}

TEST(Orthoglide, HasTheLargestCubesThatWerePublished) {
  const double half = (std::sqrt(6.0) + std::sqrt(2.0)) / 6;
  expect_largest_edge("factors_2", "sigma-max", "2", half);
  expect_largest_edge("factors_2", "sigma-min", "1/2", half);
  expect_largest_edge("factors_3", "sigma-min", "1/3", 2 / std::sqrt(17.0) + 1 / std::sqrt(11.0));
}

}  // namespace
}  // namespace regulus::detail::test
