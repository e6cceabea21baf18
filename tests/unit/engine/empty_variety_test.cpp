// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the answers of the commands if the constraints leave no pose, or perhaps none; and
// quaternions, whose norm is not a constraint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::empty_variety {
namespace {

using testing::HasSubstr;

std::string regular(const std::string& constraints) {
  return "regulus = 1\nname = \"r\"\nsource = \"a test\"\n[pose]\nx = \"1\"\ny = \"1\"\n"
         "[matrix]\nrows = [[\"x\", \"y\"], [\"-y\", \"x\"]]\n[motion.box]\nx = [0.3, 1.1]\n"
         "y = [0.2, 1.3]\nconstraints = " +
         constraints + "\n";
}

struct Report {
  Result result;
  nlohmann::ordered_json json;
  std::string text;
};

Report checked(const std::string& text, Engine engine = Engine::kInterpreted) {
  const test::TemporaryDirectory directory;
  ModelOptions model;
  model.path = directory.path() / "model.toml";
  std::ofstream(model.path) << text;
  SearchOptions search;
  search.engine = engine;
  search.use_cache = false;
  search.max_boxes = 20000;
  PreparedSearch preparation = prepare(model, search);
  const Result result = run_search(preparation, search, settings_from(search));
  return {result, json_report(preparation, search, result),
          text_report(preparation, search, result)};
}

TEST(EmptyVariety, IsAProblemAndNotAProof) {
  for (const char* constraints :
       {R"(["1 + x^2"])", R"(["x - 0.5", "0.5 + 1e-9 - x"])", R"(["1 - x - y", "x + y - 0.9"])"}) {
    const Report report = checked(regular(constraints));
    EXPECT_EQ(report.result.verdict, Verdict::kPossibleProblem) << constraints;
    EXPECT_EQ(report.json["nonempty"], false);
    EXPECT_THAT(report.json["reason"].get<std::string>(), HasSubstr("no pose remains"));
    EXPECT_THAT(report.text, HasSubstr("no pose remains"));
  }
}

TEST(EmptyVariety, IsTheSameForEveryEngine) {
  EXPECT_EQ(checked(regular(R"(["1 + x^2"])"), Engine::kJit).result.reason, Reason::kEmptyVariety);
}

TEST(EmptyVariety, IsNotSaidOfASinglePose) {
  const Report report = checked(regular(R"(["x - 0.5", "0.5 - x"])"));
  EXPECT_EQ(report.result.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(report.json["nonempty"], true);
  EXPECT_EQ(report.text.find("warning"), std::string::npos);
}

TEST(EmptyVariety, IsWarnedOfWhereItIsNotKnown) {
  const Report report = checked(regular(R"(["x^2 + y^2 - 1.1", "1.1 - x^2 - y^2"])"));
  EXPECT_EQ(report.result.verdict, Verdict::kNoSingularity);
  EXPECT_TRUE(report.json["nonempty"].is_null());
  EXPECT_THAT(report.text, HasSubstr("warning"));
}

/// Returns a hexapod with a quaternion as orientation, in a small box around a multiple of 1.
std::string hexapod(const std::string& norm) {
  return R"(regulus = 1
name = "hexapod"
source = "robot 1 of the paper"
[gough]
orientation = "quaternion"
unit = "cm"
base = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]
platform = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]
[motion.box]
x = [-1, 1]
y = [-1, 1]
z = [45, 46]
q0 = ")" +
         norm + R"("
q1 = 0
q2 = 0
q3 = 0
)";
}

TEST(Quaternion, OfAnyNormIsARotation) {
  for (const char* norm : {"1", "3", "-0.2", "0.001", "1000"}) {
    const Report report = checked(hexapod(norm));
    EXPECT_EQ(report.result.verdict, Verdict::kNoSingularity) << norm;
    EXPECT_EQ(report.json["nonempty"], true);
  }
}

TEST(Quaternion, IsUndefinedAtZero) {
  std::string text = hexapod("1");
  text.replace(text.find("q0 = \"1\""), 8, "q0 = [-0.1, 0.2]");
  const Report report = checked(text);
  EXPECT_EQ(report.result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(report.result.reason, Reason::kUndefined);
}

}  // namespace
}  // namespace regulus::detail::empty_variety
