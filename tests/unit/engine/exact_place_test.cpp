// SPDX-License-Identifier: GPL-3.0-or-later
// Singular places that no change of sign shows: lost ranks, and determinants that touch zero.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::exact_place {
namespace {

std::string model(const std::string& rows, const std::string& x, const std::string& rest = "") {
  return "regulus = 1\nname = \"three by two\"\nsource = \"a test\"\n[pose]\nx = \"rad\"\ny = "
         "\"m\"\n"
         "[matrix]\nrows = " +
         rows + "\n[motion.box]\nx = " + x + "\ny = [0.25, 1.3]\n" + rest;
}

Result checked(const std::string& text) {
  const test::TemporaryDirectory directory;
  ModelOptions options;
  options.path = directory.path() / "model.toml";
  std::ofstream(options.path) << text;
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.max_boxes = 3000;
  PreparedSearch preparation = prepare(options, search);
  return run_search(preparation, search, settings_from(search));
}

TEST(ExactPlace, IsFoundWhereAMatrixLosesRank) {
  const Result result =
      checked(model(R"~([["x", "y"], ["2*x", "3*y"], ["x*y", "y"]])~", "[-1, 1.1]"));
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kLostRank);
  ASSERT_TRUE(result.witness);
  EXPECT_TRUE(result.blocking_box.empty());
  const std::vector<Interval>& point = result.witness->points.at(0).variables;
  EXPECT_EQ(point[0].lo, 0.0);
  EXPECT_EQ(point[0].hi, 0.0);
  EXPECT_GE(point[1].lo, 0.25);
  EXPECT_LE(point[1].hi, 1.3);
}

/// The rank is 1 where cos x = 0, between two doubles.
TEST(ExactPlace, MayBeAMultipleOfPi) {
  const Result result =
      checked(model(R"~([["cos(x)", "y"], ["2*cos(x)", "3*y"], ["0", "1"]])~", "[1.5, 1.7]"));
  ASSERT_EQ(result.reason, Reason::kLostRank);
  const WitnessPoint& point = result.witness->points.at(0);
  EXPECT_EQ(point.numbers.at(0), (ExactNumber{1, 2, 1}));
  EXPECT_LT(point.variables[0].lo, point.variables[0].hi);
}

/// 2·sin x = √3 for x = π/3, and sin²x − 3/4 = 0 there.
TEST(ExactPlace, UsesRootsOfNumbers) {
  const Result result = checked(
      model(R"~([["2*sin(x) - sqrt(3)", "1"], ["sin(x)^2 - 3/4", "y"], ["0", "2"]])~", "[1, 1.1]"));
  ASSERT_EQ(result.reason, Reason::kLostRank);
  EXPECT_EQ(result.witness->points.at(0).numbers.at(0), (ExactNumber{1, 3, 1}));
}

TEST(ExactPlace, MayBeAnEndOfARange) {
  const Result result =
      checked(model(R"~([["x - pi/7", "1"], ["7*x - pi", "y"], ["0", "2"]])~", R"([0.1, "pi/7"])"));
  ASSERT_EQ(result.reason, Reason::kLostRank);
  EXPECT_EQ(result.witness->points.at(0).places.at(0), PlaceInRange::kUpperEnd);
}

TEST(ExactPlace, IsFoundWhereADeterminantTouchesZero) {
  const Result result = checked(model(R"~([["(x - 1/2)^2", "1"], ["0", "y"]])~", "[0.1, 1.3]"));
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kSmallDeterminant);
}

TEST(ExactPlace, IsNotClaimedWhereTheRankIsAlmostLost) {
  for (const char* gap : {"1e-12", "1e-40", "1e-200"}) {
    const std::string rows =
        R"~([["x", "y"], ["2*x", "3*y"], [")~" + std::string(gap) + R"~(", "y"]])~";
    const Result result = checked(model(rows, "[-1, 1.1]"));
    EXPECT_NE(result.verdict, Verdict::kSingularity) << gap;
  }
}

/// The rank is lost at x = 0 alone.
TEST(ExactPlace, IsInsideTheConstraints) {
  const std::string rows = R"~([["x", "y"], ["2*x", "3*y"], ["x*y", "y"]])~";
  EXPECT_NE(checked(model(rows, "[-1, 1.1]", "constraints = [\"1/1000000 - x\"]\n")).verdict,
            Verdict::kSingularity);
  EXPECT_EQ(checked(model(rows, "[-1, 1.1]", "constraints = [\"-x - 1/2\"]\n")).verdict,
            Verdict::kSingularity);
}

TEST(ExactPlace, IsInsideTheRange) {
  const std::string rows = R"~([["cos(x)", "y"], ["2*cos(x)", "3*y"], ["0", "1"]])~";
  EXPECT_NE(checked(model(rows, "[1.5707963267948967, 1.7]")).verdict, Verdict::kSingularity);
  EXPECT_EQ(checked(model(rows, "[1.570796326794, 1.7]")).verdict, Verdict::kSingularity);
}

/// At x = 0 the first entry is sin(x)/x, which has no value there.
TEST(ExactPlace, IsNotClaimedWhereTheModelIsUndefined) {
  const std::string rows = R"~([["sin(x)*(1/x)*x", "y"], ["x", "3*y"], ["x*y", "y"]])~";
  EXPECT_NE(checked(model(rows, "[-1, 1.1]")).verdict, Verdict::kSingularity);
}

TEST(ExactPlace, OfAThresholdIsNotAsked) {
  const Result result = checked(
      model(R"~([["(x - 1/2)^2 + 1", "1"], ["0", "y"]])~", "[0.1, 1.3]", "alpha = \"1/1000\"\n"));
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
}

}  // namespace
}  // namespace regulus::detail::exact_place
