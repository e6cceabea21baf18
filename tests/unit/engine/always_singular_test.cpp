// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/question/engine/algebra_oracle.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

/// Makes a platform whose hexagon is half that of the base, except for one coordinate.
std::string hexagons(const std::string& last) {
  return R"(regulus = 1
name = "hexagons"
source = "equal hexagons: the six legs are dependent at every pose"
[gough]
orientation = "euler-zxz"
unit = "cm"
base = [[10, 0, 0], [5, 8, 0], [-5, 8, 0], [-10, 0, 0], [-5, -8, 0], [5, -8, 0]]
platform = [[5, 0, 0], ["5/2", 4, 0], ["-5/2", 4, 0], [-5, 0, 0], ["-5/2", -4, 0], ["5/2", )" +
         last + R"(, 0]]
[motion.box]
x = [-5, 4.3]
y = [-5, 3.1]
z = [20, 25]
psi = ["-5*deg", "4*deg"]
theta = ["-5*deg", "5*deg"]
phi = ["-5*deg", "5*deg"]
)";
}

std::string two_by_two(const std::string& rows, const std::string& rest) {
  return "regulus = 1\nname = \"two\"\nsource = \"a test\"\n[pose]\nx = \"1\"\ny = \"1\"\n"
         "[matrix]\nrows = " +
         rows + "\n[motion.box]\nx = [0.3, 1.1]\ny = [0.2, 1.3]\n" + rest;
}

Result checked(const std::string& text, bool exhaustive = false) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text;
  ModelOptions model;
  model.path = path;
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.max_boxes = 500;
  PreparedSearch preparation = prepare(model, search);
  Settings settings = settings_from(search);
  settings.exhaustive = exhaustive;
  Result result = run_search(preparation, search, settings);
  close_in_on_witness(preparation, search, settings, result);
  return result;
}

TEST(AlwaysSingular, RecognisesSimilarHexagons) {
  const Result result = checked(hexagons("-4"));
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kAlwaysSingular);
  ASSERT_TRUE(result.witness);
  EXPECT_EQ(result.witness->points.front().pose.size(), 6U);
}

TEST(AlwaysSingular, IsNotSaidOfHexagonsThatAreAlmostSimilar) {
  EXPECT_NE(checked(hexagons("\"-4 - 10^(-12)\"")).reason, Reason::kAlwaysSingular);
}

TEST(AlwaysSingular, UsesPythagoras) {
  const Result result =
      checked(two_by_two(R"~([["1 - sin(x)^2", "cos(x)*y"], ["cos(x)", "y"]])~", ""));
  EXPECT_EQ(result.reason, Reason::kAlwaysSingular);
}

TEST(AlwaysSingular, ItsWitnessIsInsideTheConstraints) {
  const std::string rows = R"([["x", "2*x"], ["y", "2*y"]])";
  const Result inside = checked(two_by_two(rows, "constraints = [\"x - 0.6\"]\n"));
  ASSERT_EQ(inside.reason, Reason::kAlwaysSingular);
  EXPECT_LE(inside.witness->points.front().variables.front().hi, 0.6);
  const Result nowhere = checked(two_by_two(rows, "constraints = [\"x\"]\n"));
  EXPECT_EQ(nowhere.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(nowhere.reason, Reason::kEmptyVariety);
  EXPECT_FALSE(nowhere.witness);
}

TEST(AlwaysSingular, IsWhatAPavingFindsToo) {
  const Result result = checked(hexagons("-4"), true);
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kAlwaysSingular);
}

/// atan2(y, x) = atan(y/x) for x > 0: true, but not a polynomial identity in these functions.
TEST(AlwaysSingular, IsSaidToSeemSoWhereItIsNotProved) {
  const Result result = checked(two_by_two(R"~([["atan2(y, x)", "atan(y/x)"], ["x", "x"]])~", ""));
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_NE(result.reason, Reason::kAlwaysSingular);
  EXPECT_FALSE(result.witness);
}

TEST(AlwaysSingular, LeavesOtherVerdictsAlone) {
  EXPECT_EQ(checked(two_by_two(R"([["x", "1"], ["0", "y"]])", "")).verdict,
            Verdict::kNoSingularity);
  EXPECT_EQ(checked(two_by_two(R"([["x", "1"], ["0", "y - 0.7"]])", "")).reason,
            Reason::kOppositeSigns);
}

}  // namespace
}  // namespace regulus::detail
