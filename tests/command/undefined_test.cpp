// SPDX-License-Identifier: GPL-3.0-or-later
// The report of an undefined pose names the expression that has no value there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kUndefinedModel = R"toml(regulus = 1
name = "undefined"
source = "a test"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["sqrt(x^2 - 4) + 1", "y"], ["0", "1"]]
row_scale = ["1/sqrt(x^2 + y^2)", "1"]
[motion.root]
x = [0, 3]
y = [1, 2]
[motion.leg]
x = 2
y = [-1, 1]
[motion.defined]
x = [2, 3]
y = [1, 2]
[motion.path]
parameters = { T = [0, 1] }
x = 3
y = "1/(T - 1/2)"
[motion.curve]
parameters = { T = [0, 1] }
x = "4 - 3*T"
y = 1
)toml";

class UndefinedPose : public testing::Test {
 protected:
  UndefinedPose() { std::ofstream(path_) << kUndefinedModel; }
  CommandResult check(std::vector<std::string> words) {
    return regulus({"check", path_, "--engine", "interpreted"}, words);
  }

 private:
  TemporaryDirectory folder_;
  std::string path_ = (folder_.path() / "model.toml").string();
};

TEST_F(UndefinedPose, IsNamedWithTheRootThatIsNegative) {
  const CommandResult result = check({"root"});
  EXPECT_EQ(result.output, "POSSIBLE PROBLEM\n");
  EXPECT_THAT(result.errors, HasSubstr("undefined  sqrt(x^2 - 4), where x^2 - 4 = -1.75\n"
                                       "           at x = 1.5 m, y = 1.5 m\n"));
  EXPECT_THAT(result.errors, Not(HasSubstr("1/sqrt")));
}

TEST_F(UndefinedPose, IsReportedAsJson) {
  const json report = json::parse(check({"root", "--json"}).output);
  const json& undefined = report["undefined"];
  ASSERT_EQ(undefined["expressions"].size(), 1u);
  EXPECT_EQ(undefined["expressions"][0]["expression"], "sqrt(x^2 - 4)");
  EXPECT_EQ(undefined["expressions"][0]["argument"], "x^2 - 4");
  EXPECT_EQ(undefined["expressions"][0]["enclosure"], json({-1.75, -1.75}));
  EXPECT_EQ(undefined["pose"]["x"], json({1.5, 1.5}));
}

TEST_F(UndefinedPose, IsNamedWithTheLegOfLengthZero) {
  const CommandResult result = check({"leg", "--range", "x=0"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors,
              HasSubstr("undefined  1/sqrt(x^2 + y^2), where sqrt(x^2 + y^2) = 0\n"));
}

TEST_F(UndefinedPose, IsNamedByItsParameterWhereThePoseItselfHasNoValue) {
  const CommandResult result = check({"path", "--json"});
  const json undefined = json::parse(result.output)["undefined"];
  EXPECT_EQ(undefined["parameters"]["T"], json({0.5, 0.5}));
  EXPECT_TRUE(undefined["pose"].empty());
  EXPECT_EQ(undefined["expressions"][0]["enclosure"], json({0.0, 0.0}));
}

TEST_F(UndefinedPose, OfATrajectoryIsGivenInPoseParametersToo) {
  const CommandResult result = check({"curve"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("where the pose is x = "));
}

TEST_F(UndefinedPose, IsNotMentionedWhereAllIsDefined) {
  const CommandResult result = check({"defined", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_FALSE(json::parse(result.output).contains("undefined"));
}

}  // namespace
}  // namespace regulus::detail::test
