// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which models have a theorem about their robot, and that the reason is true where there is none.
// tests/formal/geometry.cmake lets Coq prove them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RobotTheorem : public testing::Test {
 protected:
  CommandResult write(const std::string& model, std::vector<std::string> words) {
    words.insert(words.begin(), {kCommand, "check", model});
    words.insert(words.end(), {"--certificate", certificate_, "--quiet"});
    EXPECT_LE(run_command(words).exit_code, 1);
    return run_command({kVerify, "--coq", file_, "--model", model, certificate_});
  }
  void expect_none(const std::string& model, const std::string& motion, const std::string& why) {
    const CommandResult result = write(model, {motion});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "");
    EXPECT_THAT(result.errors, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(file_));
  }
  std::string write_model(const std::string& rows, const std::string& motion) {
    const std::string model = directory_.path() / "model.toml";
    write_file(model,
               "regulus = 1\nname = \"m\"\n[pose]\nx = \"m\"\ny = \"m\"\n[let]\nright = \"x - 4\"\n"
               "[matrix]\nrows = " +
                   rows + "\n[motion.m]\n" + motion);
    return model;
  }

  TemporaryDirectory directory_;
  std::string certificate_ = directory_.path() / "certificate", file_ = directory_.path() / "m.v";
};

TEST_F(RobotTheorem, IsThatOfTheMatrixWithTheNamesOfTheFile) {
  const std::string model =
      write_model("[[\"x\", \"y\"], [\"right\", \"y\"]]", "x = [0, 4]\ny = [1, 3.0]\n");
  EXPECT_EQ(write(model, {"m"}).exit_code, 0);
  EXPECT_THAT(
      file_contents(file_),
      AllOf(
          HasSubstr("Definition the_matrix (_x _y : R) : nat -> nat -> R :=\n"
                    "  let _right := _x - 4 in\n  matrix_of\n    [[_x; _y];\n     [_right; _y]]."),
          HasSubstr("0 <= _x <= 4 /\\\n  1 <= _y <= 3.0."),
          HasSubstr("full_column_rank 2 2 (the_matrix _x _y)")));
}

TEST_F(RobotTheorem, IsRefusedForAReasonThatIsTrue) {
  const std::string rows = "[[\"x\", \"y\"], [\"right\", \"y\"]]";
  const std::string tilted = directory_.path() / "tilted.toml";
  std::ifstream from(kModels + "hunt_3rps.toml");
  std::string text((std::istreambuf_iterator<char>(from)), {});
  text.insert(text.find("[[legs.leg]]"), "axis_tolerance = 0.001\n");
  write_file(tilted, text);
  expect_none(tilted, "work", "the key 'axis_tolerance' in [legs]");
  expect_none(write_model("[[\"asin(x/10)\", \"y\"], [\"-1\", \"y\"]]", "x = [0, 4]\ny = [1, 3]\n"),
              "m", "asin, acos or atan2");
  expect_none(write_model(rows, "x = [0, 4]\ny = [-1, 3]\nconstraints = [\"x - 5\"]\n"), "m",
              "SINGULARITY of a motion with constraints");
}

}  // namespace
}  // namespace regulus::detail::test
