// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a report says what its verdict means for the robot, and in which units.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kCannotGiveWay =
    "the platform cannot give way at any pose of this motion while its legs hold";

std::string meaning_of(std::vector<std::string> words) {
  words.insert(words.begin(), {kCommand, "check"});
  words.emplace_back("--json");
  const json report = json::parse(run_command(words).output);
  return report.at("meaning").is_null() ? "null" : std::string(report.at("meaning"));
}

TEST(TheMeaningOfAVerdict, IsAboutTheRobot) {
  EXPECT_EQ(meaning_of({kRobot1, "wide_15"}), kCannotGiveWay);
  EXPECT_EQ(meaning_of({kRobot1, "wide_40"}),
            "at some pose of this motion the platform can give way although its legs hold");
  EXPECT_EQ(meaning_of({kRobot1, "T1", "--tolerance", "base=0.01"}),
            std::string(kCannotGiveWay) +
                ", whatever the uncertain quantities are within their tolerances");
  EXPECT_EQ(meaning_of({kRobot1, "T1", "--alpha", "1/100"}),
            "at every pose of this motion |det J⁻¹| is larger than 0.01");
}

TEST(TheMeaningOfAVerdict, IsAboutTheToolOfAnArm) {
  EXPECT_EQ(
      meaning_of({REGULUS_SOURCE_DIR "/models/puma_560_serial.toml", "wrist"}),
      "at some pose of this motion the joints cannot move the tool in all 6 directions of its "
      "matrix");
}

/// A palletizer: its four joints do not move the tool in all directions of a matrix of more rows.
constexpr const char* kPalletizer = R"toml(regulus = 1
name = "palletizer"
[serial]
joints = [
  { name = "q1" },
  { name = "q2", xyz = [1, 0, 1], axis = [0, 1, 0] },
  { name = "q3", xyz = [0, 0, 1], axis = [0, 1, 0] },
  { mimic = "q3", multiplier = -1, xyz = [1, 0, 0], axis = [0, 1, 0] },
  { mimic = "q2", multiplier = -1, axis = [0, 1, 0] },
  { name = "q4" },
]
[motion.free]
q1 = [-1, 1]
q2 = [-0.5, 0.5]
q3 = [-0.5, 0.5]
q4 = 0
[motion.lost]
q1 = [-1, 1]
q2 = [0.5, 1.5]
q3 = [0.5, 2.5]
q4 = 0
)toml";

TEST(TheMeaningOfAVerdict, IsAboutTheJointsOfAnArmOfFewJoints) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "palletizer.toml").string();
  std::ofstream(path) << kPalletizer;
  EXPECT_EQ(meaning_of({path, "free"}),
            "at every pose of this motion each motion of the 4 joints moves the tool");
  EXPECT_EQ(meaning_of({path, "lost"}),
            "at some pose of this motion the 4 joints can move and leave the tool at rest");
}

TEST(TheMeaningOfAVerdict, SaysThatAMatrixIsReduced) {
  EXPECT_EQ(meaning_of({REGULUS_SOURCE_DIR "/models/tsai_3upu_reduced.toml", "wide"}),
            "as far as the reduced matrix says, the matrix loses rank at no pose of this motion");
}

/// A model whose matrix has no names of columns does not say that there is a platform.
TEST(TheMeaningOfAVerdict, SpeaksOfNoPlatformThatIsNotThere) {
  EXPECT_EQ(meaning_of({REGULUS_SOURCE_DIR "/models/rump.toml"}),
            "the matrix loses rank at no pose of this motion");
  EXPECT_EQ(meaning_of({REGULUS_SOURCE_DIR "/models/puma_560.toml", "wrist"}),
            "at some pose of this motion the matrix loses rank");
  EXPECT_THAT(meaning_of({REGULUS_SOURCE_DIR "/models/orthoglide_full.toml", "cube"}),
              HasSubstr("the platform cannot give way"));
}

TEST(TheMeaningOfAVerdict, IsNothingWhereNothingIsProved) {
  EXPECT_EQ(
      meaning_of({kRobot1, "wide_15", "--tolerance", "base,platform=0.134", "--max-boxes", "8"}),
      "null");
  const CommandResult result = run_command({kCommand, "check", kRobot1, "wide_15", "--tolerance",
                                            "base,platform=0.134", "--max-boxes", "8"});
  EXPECT_THAT(result.errors,
              HasSubstr("claim      nothing is proved: the limit on the number of boxes"));
  EXPECT_THAT(result.errors, Not(HasSubstr("meaning")));
}

TEST(UnitsOfAReport, HasTheUnitsOfLengths) {
  const CommandResult result =
      run_command({kCommand, "check", kRobot1, "T1", "--tolerance", "base=0.01"});
  EXPECT_THAT(result.errors, HasSubstr("18 of base ±0.01 cm"));
  EXPECT_THAT(run_command({kCommand, "check", kRobot1, "wide_40"}).errors,
              testing::ContainsRegex("witness    x = [-0-9.]+ cm, y = .* rad"));
}

/// What a constant of [geometry] is measured in, no file says.
TEST(UnitsOfAReport, HasThoseOfAWrench) {
  EXPECT_THAT(run_command({kCommand, "check", kRobot1, "table4_1", "--load", "payload"}).errors,
              testing::ContainsRegex("corner \\([-0-9., ]+\\) N, \\([-0-9., ]+\\) N cm\n.*along "
                                     "\\([-0-9., ]+\\) cm, \\([-0-9., ]+\\) rad, approximately, it "
                                     "needs [0-9.]+ N cm, the forces give at most [0-9.]+ N cm"));
}

TEST(UnitsOfAReport, HasThoseOfAPoseOnAWay) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "way.csv").string();
  std::ofstream(path) << "t,x,y,z,psi,theta,phi\n0,0,0,47,0,0,0\n1,1,0,47,0,0,0\n";
  const std::string report = run_command({kCommand, "bound", kRobot1, "table4_1", "force", "--load",
                                          "payload", "--leg", "1", "--waypoints", path})
                                 .errors;
  EXPECT_THAT(report, testing::ContainsRegex("x = [-0-9.]+ cm, .*psi = [-0-9.]+ rad"));
  EXPECT_THAT(report, testing::ContainsRegex("load_payload_1 = [-0-9.]+ N, .*load_payload_6 = "
                                             "[-0-9.]+ N cm"));
}

TEST(UnitsOfAReport, HasThoseOfTheLengthsOfAnArm) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "arm.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"arm\"\n[serial]\nunit = \"mm\"\n"
                         "length_tolerance = 0\njoints = [{ name = \"q1\" }, "
                         "{ name = \"q2\", xyz = [300, 0, 0] }]\ntool = { xyz = [200, 0, 0] }\n"
                         "[motion.m]\nq1 = [0, 1]\nq2 = [0.5, 1]\n";
  EXPECT_THAT(
      run_command({kCommand, "margin", path, "--tolerance", "lengths=0:1/64", "--quiet"}).output,
      testing::EndsWith(" mm\n"));
}

TEST(UnitsOfAReport, HasNoUnitThatTheModelDoesNotGive) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "mixed.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"mixed\"\n[pose]\nx = \"m\"\n[geometry]\n"
                         "h = { value = 1, tolerance = 0, group = \"base\" }\n"
                         "[matrix]\nrows = [[\"x + h\"]]\n[motion.m]\nx = [0, 1]\n";
  EXPECT_EQ(run_command({kCommand, "margin", path, "--tolerance", "base=0:0.5", "--quiet"}).output,
            "SAFE UP TO 0.5\n");
  EXPECT_EQ(
      run_command({kCommand, "margin", kRobot1, "T1", "--tolerance", "base=0:1/64", "--quiet"})
          .output,
      "SAFE UP TO 1/64 cm\n");
}

}  // namespace
}  // namespace regulus::detail::test
