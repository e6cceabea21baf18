// SPDX-License-Identifier: GPL-3.0-or-later
// --weight: which range is split, and what is said of a wrong weight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

CommandResult check(const std::vector<std::string>& more) {
  std::vector<std::string> words = {kCommand,    "check",    kModels + "robot_2.toml",
                                    "table5_30", "--method", "kj"};
  words.insert(words.end(), more.begin(), more.end());
  return run_command(words);
}

TEST(Weights, ChangeWhatIsSplitAndNoVerdict) {
  const std::vector<std::string> weighted = {"--bisect", "weighted", "--json"};
  const auto report = [&](std::vector<std::string> more) {
    more.insert(more.begin(), weighted.begin(), weighted.end());
    return nlohmann::json::parse(check(more).output);
  };
  const auto plain = report({}), ones = report({"--weight", "x=1", "--weight", "psi=1.0"}),
             other = report({"--weight", "psi=8", "--weight", "theta=8"});
  EXPECT_FALSE(plain["options"].contains("weights"));
  EXPECT_EQ(other["options"]["weights"], nlohmann::json({"psi=8", "theta=8"}));
  for (const nlohmann::json* one : {&plain, &ones, &other})
    EXPECT_EQ(one->at("verdict"), "no-singularity");
  EXPECT_EQ(plain.at("boxes"), ones.at("boxes"));
  EXPECT_NE(plain.at("boxes"), other.at("boxes"));
}

TEST(Weights, AreRefusedWithTheirText) {
  for (const auto& [words, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--weight", "x=2"}, "--weight goes with --bisect weighted"},
           {{"--bisect", "weighted", "--weight", "w=2"}, "'w=2' is no NAME=W"},
           {{"--bisect", "weighted", "--weight", "x"}, "'x' is no NAME=W"},
           {{"--bisect", "weighted", "--weight", "x=0"}, "'x=0' has no number above 0"},
           {{"--bisect", "weighted", "--weight", "x=-1"}, "'x=-1' has no number above 0"},
           {{"--bisect", "weighted", "--weight", "x=2y"}, "'x=2y' has no number above 0"}}) {
    const CommandResult result = check(words);
    EXPECT_EQ(result.exit_code, 64) << why;
    EXPECT_THAT(result.errors, HasSubstr(why));
  }
}

}  // namespace
}  // namespace regulus::detail::test
