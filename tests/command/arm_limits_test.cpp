// SPDX-License-Identifier: GPL-3.0-or-later
// What a question about an arm may leave, what it warns of, and what has no answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class Arm : public testing::Test {
 protected:
  void SetUp() override {
    write_file(model_,
               "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"standard-dh\"\njoints = [\n"
               "{ name = \"q1\", a = 1 },\n{ name = \"q2\", a = 1 }]\n"
               "[motion.limits]\nq1 = [-1, 1]\nq2 = [0.5, 1]\n");
  }

  [[nodiscard]] CommandResult run(const std::string& command,
                                  std::vector<std::string> words) const {
    return regulus({command, model_, "limits"}, words);
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "arm.toml";
  std::string points_ = directory_.path() / "points.csv";
};

TEST_F(Arm, StaysWithinItsLimitsAlongWayPoints) {
  write_file(points_, "q1,q2\n0,0.75\n0,1.25\n");
  const CommandResult refused = run("check", {"--waypoints", points_});
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_THAT(refused.errors, HasSubstr("points.csv:3: q2 takes 1.25 rad, beyond its limits"));
  const CommandResult allowed =
      run("check", {"--waypoints", points_, "--beyond-limits", "--quiet"});
  EXPECT_EQ(allowed.exit_code, 0);
  EXPECT_THAT(allowed.errors, HasSubstr("the question leaves the limits of joints: q2"));
}

TEST_F(Arm, StaysWithinItsLimitsWhereItsRangesGrow) {
  const CommandResult refused = run("margin", {"--scale", "0.5:1.5"});
  EXPECT_EQ(refused.exit_code, 64);
  EXPECT_THAT(refused.errors, HasSubstr("at 1.5, q1 takes [-1.5, 1.5] rad, beyond its limits"));
  EXPECT_EQ(run("margin", {"--scale", "0.5:"}).exit_code, 64);
  EXPECT_EQ(run("margin", {"--scale", "0.5:1", "--quiet"}).output,
            "SAFE UP TO 1 times the ranges\n");
  EXPECT_EQ(run("margin", {"--scale", "0.5:1.5", "--quiet", "--beyond-limits"}).output,
            "SAFE UP TO 1.5 times the ranges\n");
}

/// Nothing of the arm grows in a bound.
TEST_F(Arm, HasBoundsBeyondItsLimits) {
  const CommandResult result = run("bound", {"q2", "--range", "q2=0.5:2", "--beyond-limits"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("BETWEEN"));
  EXPECT_THAT(result.errors, HasSubstr("the question leaves the limits of joints: q2"));
}

TEST_F(Arm, LeavesItsLimitsInJsonToo) {
  const CommandResult result = run("check", {"--range", "q2=0.5:2", "--beyond-limits", "--json"});
  EXPECT_THAT(json::parse(result.output)["notes"].dump(), HasSubstr("leaves the limits of joints"));
}

TEST_F(Arm, InRadiansGetsItsWarningUnderQuietAndFromTheCache) {
  write_file(model_,
             "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"standard-dh\"\njoints = [\n"
             "{ name = \"q1\", a = 1, alpha = 90 },\n{ name = \"q2\", a = 1 }]\n"
             "[motion.limits]\nq1 = [-1, 1]\nq2 = [0.5, 1]\n");
  for (int time = 0; time < 2; ++time)
    EXPECT_THAT(run("check", {"--quiet"}).errors,
                HasSubstr("arm.toml:6: serial.joints[1].alpha is 90 rad, more than a turn"));
}

TEST_F(Arm, HasADatasheetThatSaysWhatHasNoAnswer) {
  const CommandResult sheet = run("datasheet", {});
  EXPECT_EQ(sheet.exit_code, 2);
  for (const char* name : {"no quantity of this model is bounded", "force", "speed", "error",
                           "sigma-min", "condition", "determinant"})
    EXPECT_THAT(sheet.output, HasSubstr(name));
}

TEST(Explain, ShowsAllEntriesInFull) {
  const std::string model = REGULUS_SOURCE_DIR "/tests/models/legs/planar_3rrr.toml";
  TemporaryDirectory directory;
  const std::string path = directory.path() / "legs.toml";
  write_file(path, file_contents(model) + "[motion.zero]\nx = 0\ny = 0\nphi = 0\n");
  EXPECT_THAT(regulus({"explain", path}).output, HasSubstr("characters more"));
  const std::string all = regulus({"explain", path, "--all"}).output;
  EXPECT_THAT(all, Not(HasSubstr("characters more")));
  EXPECT_THAT(all, Not(HasSubstr("symbols and operations")));
}

TEST(Claims, NameTheGroupsOfUncertainQuantities) {
  const json report = json::parse(
      regulus({"check", kRobot1, "T2_errors", "--tolerance", "base,platform=0.01", "--json"})
          .output);
  EXPECT_THAT(report["claim"].get<std::string>(),
              HasSubstr("(18 of base, 18 of platform, 6 control errors)"));
  EXPECT_EQ(report["question"]["groups"],
            json::parse("[{\"group\": \"base\", \"kind\": \"geometry\", \"quantities\": 18},"
                        "{\"group\": \"platform\", \"kind\": \"geometry\", \"quantities\": 18},"
                        "{\"group\": \"\", \"kind\": \"control\", \"quantities\": 6}]"));
}

/// The lines of the question without those about the file and its names.
std::vector<std::string> question_of(const std::string& model, const std::string& certificate) {
  EXPECT_EQ(regulus({"check", model, "here", "--certificate", certificate}).exit_code, 0);
  std::vector<std::string> lines;
  std::istringstream text(file_contents(certificate));
  for (std::string line; std::getline(text, line);) {
    const std::string word = line.substr(0, line.find(' '));
    if (word != "claim" && word != "model" && word != "sha256" && word != "constant")
      lines.push_back(line);
  }
  return lines;
}

TEST(Certificates, OfNumbersNamesAndExpressionsStateTheSameQuestion) {
  const TemporaryDirectory directory;
  const std::string model = directory.path() / "legs.toml", proof = directory.path() / "proof";
  const auto question = [&](const std::string& crank, const std::string& base) {
    std::string text =
        "regulus = 1\nname = \"legs\"\n[geometry]\nL = 120\n[legs]\nbase_tolerance = 0.1\n"
        "crank_tolerance = 0.1\nrod_tolerance = 0.1\n";
    text += "[[legs.leg]]\ntype = \"RRR\"\nbase = [0, 0]\nplatform = [-30, -20]\ncrank = " + crank +
            "\nrod = 150\nmode = \"+\"\n[[legs.leg]]\ntype = \"RPR\"\nbase = [" + base +
            ", 0]\nplatform = [30, -20]\n[[legs.leg]]\ntype = \"PRR\"\nbase = [0, 300]\n"
            "platform = [0, 40]\naxis = [1, 0]\nrod = 160\nmode = \"-\"\n"
            "[motion.here]\nx = [140, 150]\ny = [165, 175]\nphi = 0\n";
    write_file(model, text);
    return question_of(model, proof);
  };
  const std::vector<std::string> written = question("120", "300");
  EXPECT_EQ(question("\"L\"", "\"2*L + 60\""), written);
  EXPECT_EQ(question("\"2*L*cos(60deg)\"", "\"5*L/2\""), written);
}

}  // namespace
}  // namespace regulus::detail::test
