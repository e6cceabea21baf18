// SPDX-License-Identifier: GPL-3.0-or-later
// The Orthoglide's published property: over its cube the platform's velocity is between 1/2 and 2
// times that of the motors, and no larger cube has it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"

namespace regulus::test {
namespace {

CommandResult bound(const std::string& quantity, const std::string& limit, double size) {
  // The cube about the middle of the published one, with `size` times its edge.
  const double middle = (std::sqrt(2.0) / 6 - 1 / std::sqrt(6.0)) / 2;
  const double half = size * (std::sqrt(2.0) / 6 + 1 / std::sqrt(6.0)) / 2;
  std::vector<std::string> words{REGULUS_BINARY_DIR "/bin/regulus",
                                 "bound",
                                 REGULUS_SOURCE_DIR "/models/orthoglide.toml",
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

}  // namespace
}  // namespace regulus::test
