// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus list`, and models that are found by their names.
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

/// Returns the result of a command in another working directory.
CommandResult regulus_in(const std::string& folder, const std::string& words) {
  return run_command({"/bin/sh", "-c", "cd '" + folder + "' && '" + kCommand + "' " + words});
}

TEST(List, NamesEveryModelOfTheFolder) {
  const json listed = json::parse(regulus({"list", "--json"}).output);
  std::vector<std::string> names;
  for (const json& model : listed["models"]) names.push_back(model["name"]);
  std::vector<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(REGULUS_SOURCE_DIR "/models"))
    if (file.path().extension() == ".toml") files.push_back(file.path().stem());
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(files));
  EXPECT_THAT(regulus({"list"}).output, HasSubstr("robot_1 "));
  EXPECT_THAT("\n" + regulus({"list", "--quiet"}).output, HasSubstr("\nrobot_1\n"));
}

TEST(List, ShowsMotionsWithRangesAndGroupsWithTolerances) {
  const CommandResult shown = regulus({"list", "planar_3rpr"});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(regulus({"list", "planar_3rpr", "--quiet"}).output,
            "regular\ncrossing\ncircle\nreach\ndisk\n");
  EXPECT_THAT(shown.output, HasSubstr("motion     regular\n           x in [-2, 4]\n"));
  EXPECT_THAT(shown.output, HasSubstr("phi in [-0.261799, 0.0872665] rad"));
  EXPECT_THAT(shown.output, HasSubstr("x = 1 + 3*cos(2*T*pi)"));
  EXPECT_THAT(shown.output, HasSubstr("group      base: tolerance 0 (a1_1 … a3_2, 6 constants)"));
}

constexpr const char* kArmInDegrees = R"toml(regulus = 1
name = "arm in degrees"
[serial]
unit = "mm"
angle_unit = "deg"
length_tolerance = 0.2
angle_tolerance = 0.05
joints = [ { name = "q1" }, { name = "q2", xyz = [300, 0, 0], rpy = [90, 0, 0] }, { name = "q3", xyz = [200, 0, 50] } ]
[motion.work]
q1 = 0
q2 = [20, 60]
q3 = [-90, 90]
)toml";

TEST(List, ShowsTolerancesWithTheirUnits) {
  const TemporaryDirectory folder;
  const std::string arm = (folder.path() / "arm.toml").string();
  std::ofstream(arm) << kArmInDegrees;
  const std::string listed = regulus({"list", arm}).output;
  EXPECT_THAT(listed, HasSubstr("lengths: tolerance 0.2 mm ("));
  EXPECT_THAT(listed, HasSubstr("angles: tolerance 0.000872665 rad (0.05 deg) ("));
  EXPECT_THAT(regulus({"check", arm}).errors, HasSubstr("of angles ±0.000872665 rad (0.05 deg)"));
}

TEST(List, ShowsABallOnce) {
  const std::string listed = regulus({"list", "orthoglide"}).output;
  EXPECT_THAT(listed, HasSubstr("(0, 0, 0) in a ball of 1"));
  EXPECT_THAT(listed, testing::Not(HasSubstr("0 in a ball")));
}

TEST(List, RefusesAModelWithAMistake) {
  const TemporaryDirectory folder;
  std::ofstream((folder.path() / "wrong.toml").string()) << "regulus = 1\n";
  EXPECT_EQ(regulus({"list", (folder.path() / "wrong.toml").string()}).exit_code, 65);
}

TEST(InstalledModel, IsFoundByItsNameAndItsFileIsReported) {
  const CommandResult found = regulus({"check", "planar_3rpr", "regular"});
  EXPECT_EQ(found.output, "NO SINGULARITY\n");
  EXPECT_THAT(found.errors, HasSubstr("file       "));
  EXPECT_THAT(found.errors, HasSubstr("models/planar_3rpr.toml\n"));
  const json report =
      json::parse(regulus({"check", "planar_3rpr", "regular", "--json", "--quiet"}).output);
  EXPECT_THAT(std::string(report["model_file"]), HasSubstr("models/planar_3rpr.toml"));
}

TEST(InstalledModel, GivesWayToAFileOfThatName) {
  const TemporaryDirectory folder;
  std::ofstream((folder.path() / "planar_3rpr").string()) << "not a model";
  const CommandResult own = regulus_in(folder.path().string(), "check planar_3rpr regular");
  EXPECT_EQ(own.exit_code, 65);
  EXPECT_THAT(own.errors, HasSubstr("planar_3rpr:1: "));
}

TEST(InstalledModel, IsSuggestedForAMistypedName) {
  const CommandResult mistyped = regulus({"check", "planar_3rp", "regular"});
  EXPECT_EQ(mistyped.exit_code, 74);
  EXPECT_THAT(mistyped.errors, HasSubstr("did you mean 'planar_3rpr'?"));
}

TEST(InstalledModel, IsLoadedByItsNameInTheShell) {
  const CommandResult shell =
      run_command({"/bin/sh", "-c",
                   "printf 'list planar_3rpr\\nload planar_3rpr\\n' | '" + kCommand + "' shell"});
  EXPECT_EQ(shell.exit_code, 0);
  EXPECT_THAT(shell.output, HasSubstr("planar 3-RPR: 3×3"));
}

}  // namespace
}  // namespace regulus::detail::test
