// SPDX-License-Identifier: GPL-3.0-or-later
// From robot files to verdicts, with the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/robots/robot_file.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// An arm, and a region that is 5° or more away from its singular poses.
struct Region {
  std::string arm;
  std::vector<std::string> ranges;
};

const std::vector<Region> kRegions = {
    {"crx10ial", {"joint_2=5*deg:35*deg", "joint_3=-15*deg:15*deg", "joint_5=45*deg:75*deg"}},
    {"irb2400", {"joint_2=5*deg:35*deg", "joint_3=-15*deg:15*deg", "joint_5=45*deg:75*deg"}},
    {"kr16_2", {"joint_a2=5*deg:35*deg", "joint_a3=75*deg:105*deg", "joint_a5=45*deg:75*deg"}},
    {"lrmate200id", {"joint_2=5*deg:35*deg", "joint_3=-15*deg:15*deg", "joint_5=45*deg:75*deg"}},
    {"mh5", {"joint_l=5*deg:35*deg", "joint_u=-15*deg:15*deg", "joint_b=45*deg:75*deg"}},
    {"rx160", {"joint_2=5*deg:35*deg", "joint_3=75*deg:105*deg", "joint_5=45*deg:75*deg"}},
    {"ur5e",
     {"shoulder_lift_joint=-35*deg:-5*deg", "elbow_joint=75*deg:105*deg",
      "wrist_1_joint=-105*deg:-75*deg", "wrist_2_joint=45*deg:75*deg"}},
    {"iiwa14",
     {"iiwa_joint_2=10*deg:30*deg", "iiwa_joint_3=-10*deg:10*deg", "iiwa_joint_4=70*deg:90*deg",
      "iiwa_joint_5=-10*deg:10*deg", "iiwa_joint_6=50*deg:70*deg"}},
    {"panda",
     {"panda_joint2=10*deg:30*deg", "panda_joint3=-10*deg:10*deg", "panda_joint4=-90*deg:-70*deg",
      "panda_joint5=-10*deg:10*deg", "panda_joint6=100*deg:120*deg"}},
    {"sia20d",
     {"joint_l=10*deg:30*deg", "joint_e=-10*deg:10*deg", "joint_u=70*deg:90*deg",
      "joint_r=-10*deg:10*deg", "joint_b=50*deg:70*deg"}}};

class ImportedArm : public testing::TestWithParam<Region> {
 protected:
  void SetUp() override {
    model_ = directory_.path() / "arm.toml";
    const CommandResult result =
        regulus({"import", robot_path(GetParam().arm + ".urdf"), "-o", model_, "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
  }

  std::string verdict(const std::vector<std::string>& words) {
    std::vector<std::string> line = {kCommand,  "check",       model_, "limits",
                                     "--quiet", "--max-boxes", "3000"};
    line.insert(line.end(), words.begin(), words.end());
    return run_command(line).output;
  }

  TemporaryDirectory directory_;
  std::string model_;
};

/// No sign changes where the Jacobian of seven joints loses rank. The singular poses of the Panda have
/// no simple angles: a small box has one.
TEST_P(ImportedArm, IsSingularWithinItsLimits) {
  EXPECT_EQ(verdict({"--certificate", model_ + ".proof"}), "SINGULARITY\n");
  const CommandResult verified = regulus({"verify", model_ + ".proof", "--model", model_});
  EXPECT_EQ(verified.exit_code, 0) << verified.errors;
}

TEST_P(ImportedArm, IsRegularAwayFromTheSingularPoses) {
  std::vector<std::string> words;
  for (const std::string& range : GetParam().ranges) {
    words.emplace_back("--range");
    words.push_back(range);
  }
  EXPECT_EQ(verdict(words), "NO SINGULARITY\n");
}

INSTANTIATE_TEST_SUITE_P(Urdf, ImportedArm, testing::ValuesIn(kRegions),
                         [](const auto& region) { return region.param.arm; });

TEST(ImportCommand, PrintsTheModelWithoutAFile) {
  const CommandResult result = regulus({"import", robot_path("ur5e.urdf"), "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("[serial] # from link 'base_link'"));
}

TEST(ImportCommand, HasAnExitCodeForEachKindOfMistake) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "r.urdf";
  EXPECT_EQ(regulus({"import", file}).exit_code, 74);
  std::ofstream(file) << "<robot>";
  EXPECT_EQ(regulus({"import", file}).exit_code, 65);
  EXPECT_EQ(regulus({"import", robot_path("ur5e.urdf"), "--tip", "hand"}).exit_code, 64);
  EXPECT_EQ(regulus({"import", robot_path("ur5e.urdf"), "-o", directory.path()}).exit_code, 74);
}

TEST(ImportCommand, NeverOverwritesAModelThatAPersonHasEdited) {
  const TemporaryDirectory directory;
  const std::string model = directory.path() / "arm.toml";
  const auto import = [&] {
    return regulus({"import", robot_path("ur5e.urdf"), "-o", model, "--quiet"});
  };
  ASSERT_EQ(import().exit_code, 0);
  const std::string written = file_contents(model);
  EXPECT_EQ(import().exit_code, 0);
  EXPECT_EQ(file_contents(model + ".old"), written);

  std::ofstream(model, std::ios::app) << "# my motion\n";
  const CommandResult refused = import();
  EXPECT_EQ(refused.exit_code, 74);
  EXPECT_THAT(refused.errors, HasSubstr("arm.toml was not written by regulus import, or was edited "
                                        "since; move it, or name another file"));
  EXPECT_EQ(file_contents(model), written + "# my motion\n");

  // Moved to a name that the next run would replace.
  std::filesystem::rename(model, model + ".old");
  EXPECT_EQ(import().exit_code, 0);
  EXPECT_EQ(import().exit_code, 74);
  EXPECT_EQ(file_contents(model + ".old"), written + "# my motion\n");

  std::ofstream(model) << "another file\n";
  EXPECT_EQ(import().exit_code, 74);
  EXPECT_EQ(file_contents(model), "another file\n");
}

TEST(ImportCommand, MakesAPlatformOfAHexapod) {
  const TemporaryDirectory directory;
  const std::string model = directory.path() / "hexapod.toml";
  for (const char* file : {"hexapod.mjcf", "hexapod.sdf"}) {
    ASSERT_EQ(regulus({"import", robot_path(file), "-o", model, "--quiet"}).exit_code, 0);
    EXPECT_EQ(regulus({"check", model, "around_home", "--quiet"}).output, "NO SINGULARITY\n")
        << file;
  }
}

}  // namespace
}  // namespace regulus::detail::test
