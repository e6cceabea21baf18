// SPDX-License-Identifier: GPL-3.0-or-later
// Tests robots in C++: a check in process, and the examples against the same robots' model files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "codegen/kernel/cpp/emit.hpp"
#include "codegen/kernel/formulation/functions_needed.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/model/request.hpp"
#include "codegen/use/api/check.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

/// Returns a robot with det = x² + y² − h², singular on a circle.
Robot circle() {
  Robot robot("circle");
  const Formula x = robot.pose("x", "cm"), y = robot.pose("y", "cm");
  const Formula h = robot.uncertain("h", 1, 0, "platform");
  robot.matrix({{x - h, y}, {-y, x + h}});
  robot.motion("outside").range(x, 2, 3).range(y, 2, 3);
  robot.motion("across").range(x, 0, 3).range(y, 0, 3);
  return robot;
}

TEST(CheckOfARobot, ProvesThatThereIsNoSingularity) {
  const Finding finding = check(Question(circle(), "outside"));
  EXPECT_EQ(finding.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(finding.claim, "the full 2×2 matrix has full rank for every pose of the motion");
  EXPECT_THAT(finding.report, testing::HasSubstr("x in [2, 3] cm"));
  EXPECT_EQ(nlohmann::json::parse(finding.json)["verdict"], "no-singularity");
}

TEST(CheckOfARobot, ShowsASingularPose) {
  const Finding finding = check(Question(circle(), "across"));
  ASSERT_EQ(finding.verdict, Verdict::kSingularity);
  ASSERT_TRUE(finding.result.witness);
  EXPECT_EQ(finding.variables, (std::vector<std::string>{"x", "y"}));
}

TEST(CheckOfARobot, TakesTheChangesThatTheCommandTakes) {
  EXPECT_EQ(check(Question(circle(), "outside").tolerance("platform", "2")).verdict,
            Verdict::kSingularity);
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  EXPECT_EQ(check(Question(circle(), "outside").range("x", "0", "3").range("y", "0", "3"), options)
                .verdict,
            Verdict::kSingularity);
}

TEST(CheckOfARobot, RefusesWhatTheRobotOrTheQuestionHasNot) {
  EXPECT_THROW(static_cast<void>(check(Question(circle(), "inside"))), UsageError);
  EXPECT_THROW(static_cast<void>(Question(Robot("empty"))), InputError);
}

/// Returns the first program of the page for authors.
std::string program_of_the_page() {
  std::ifstream page(REGULUS_SOURCE_DIR "/codegen/model/robot/AUTHORS.md");
  std::string line, program;
  while (std::getline(page, line) && line != "```cpp") continue;
  while (std::getline(page, line) && line != "```") program += line + '\n';
  return program;
}

TEST(AuthorsPage, ShowsTheExampleThatIsBuilt) {
  std::ifstream file(REGULUS_SOURCE_DIR "/codegen/model/robot/examples/slider.cpp");
  const std::string source{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(program_of_the_page().size(), 100U);
  EXPECT_THAT(source, testing::EndsWith(program_of_the_page()));
}

std::string example(const std::string& name) {
  return test::run_command({REGULUS_BINARY_DIR "/bin/examples/" + name}).output;
}

std::string shipped(const std::string& name) {
  return read_model_text(std::string(REGULUS_SOURCE_DIR "/models/") + name + ".toml");
}

/// Returns the kernel's text without the origin of the numbers and the module's digest.
std::string kernel_of(const Model& model, const std::string& motion) {
  Module module =
      lower(formulate(model, find_motion(model, motion), functions_needed(Method::kAuto)));
  module.model.clear();
  return emit(module).source;
}

struct Verdicts {
  std::vector<std::string> motions;
  std::vector<std::string> options;
};

/// Returns the verdict and the number of boxes for each motion.
std::string verdicts(const std::string& text, const Verdicts& of) {
  const test::TemporaryDirectory directory;
  const std::string file = (directory.path() / "model.toml").string();
  std::ofstream(file) << text;
  std::string all;
  for (const std::string& motion : of.motions) {
    std::vector<std::string> words = {kCommand, "check",   file,       motion,
                                      "--json", "--quiet", "--engine", "interpreted"};
    words.insert(words.end(), of.options.begin(), of.options.end());
    const auto report = nlohmann::json::parse(test::run_command(words).output);
    all +=
        motion + " " + report["verdict"].get<std::string>() + " " + report["boxes"].dump() + "\n";
  }
  return all;
}

TEST(ExampleRobots, TheSliderIsRegularWhereThePageMovesIt) {
  EXPECT_EQ(verdicts(example("slider"), {{"near", "swing"}, {}}),
            "near no-singularity 1\nswing no-singularity 1\n");
}

TEST(ExampleRobots, ThePlanar3RprHasTheKernelOfItsModelFile) {
  for (const char* motion : {"crossing", "circle", "reach"})
    EXPECT_EQ(kernel_of(parse_model(example("planar_3rpr"), "C++"), motion),
              kernel_of(parse_model(shipped("planar_3rpr"), "file"), motion));
}

TEST(ExampleRobots, ThePlanar3RprHasTheVerdictsOfItsModelFile) {
  const Verdicts all{{"regular", "crossing", "circle", "reach"}, {"--tolerance", "base=0.1"}};
  EXPECT_EQ(verdicts(example("planar_3rpr"), all), verdicts(shipped("planar_3rpr"), all));
}

/// Removes the row scale. The [gough] form knows that it is defined wherever the matrix is regular;
/// a matrix written out does not know this, so its kernel tests it.
Model without_row_scale(Model model) {
  model.row_scale.clear();
  model.must_be_defined.clear();
  return model;
}

TEST(ExampleRobots, TheGough6UpsHasTheMatrixAndTheProductsOfTheGoughTable) {
  EXPECT_EQ(kernel_of(without_row_scale(parse_model(example("gough_6ups"), "C++")), "wide_15"),
            kernel_of(without_row_scale(parse_model(shipped("robot_1"), "file")), "wide_15"));
}

TEST(ExampleRobots, TheGough6UpsHasTheVerdictsOfTheGoughTable) {
  const Verdicts all{{"table4_5", "wide_15", "wide_40"}, {"--tolerance", "base,platform=0.02"}};
  EXPECT_EQ(verdicts(example("gough_6ups"), all), verdicts(shipped("robot_1"), all));
}

}  // namespace
}  // namespace regulus::detail::test
