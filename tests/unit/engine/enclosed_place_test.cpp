// SPDX-License-Identifier: GPL-3.0-or-later
// Singular places in general position: they are enclosed, with their null vectors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::enclosed_place {
namespace {

/// x in the first range, y in [0.25, 1.3], and perhaps uncertain quantities.
struct Asked {
  std::string rows, x = "[-1, 1.9]", rest = "", constants = "", y = "[0.25, 1.3]";
};

Result checked(const Asked& asked) {
  const test::TemporaryDirectory directory;
  ModelOptions options;
  options.path = directory.path() / "model.toml";
  std::ofstream(options.path) << "regulus = 1\nname = \"a test\"\nsource = \"a test\"\n"
                              << (asked.constants.empty() ? "" : "[geometry]\n" + asked.constants)
                              << "[pose]\nx = \"rad\"\ny = \"m\"\n[matrix]\nrows = " << asked.rows
                              << "\n[motion.box]\nx = " << asked.x << "\ny = " << asked.y << '\n'
                              << asked.rest;
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.max_boxes = 3000;
  PreparedSearch preparation = prepare(options, search);
  return run_search(preparation, search, settings_from(search));
}

/// Rank 1 where e^x = 2 and y·e^x = 1.7: (−1, 1) is the null vector.
const std::string kTall = R"~([["exp(x)", "2"], ["2", "2"], ["y*exp(x)", "1.7"]])~";
const double kX = std::log(2.0), kY = 0.85;

void expect_at(const Result& result, double x, double y) {
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  ASSERT_EQ(result.reason, Reason::kNullVector);
  EXPECT_TRUE(result.blocking_box.empty());
  const WitnessPoint& point = result.witness->points.at(0);
  EXPECT_NEAR(mid(point.variables.at(0)), x, 1e-10);
  EXPECT_NEAR(mid(point.variables.at(1)), y, 1e-10);
  for (const Interval& range : point.variables) EXPECT_LE(range.hi - range.lo, 1e-10);
  for (const Interval& component : point.null_vector) EXPECT_LE(component.hi - component.lo, 1e-10);
}

TEST(EnclosedPlace, IsFoundWhereAMatrixLosesRank) {
  const Result result = checked({kTall});
  expect_at(result, kX, kY);
  const WitnessPoint& point = result.witness->points.at(0);
  EXPECT_EQ(point.chosen, (std::vector<std::uint32_t>{0, 1}));
  ASSERT_EQ(point.null_vector.size(), 2U);
  EXPECT_NEAR(mid(point.null_vector[0]) / mid(point.null_vector[1]), -1, 1e-10);
}

TEST(EnclosedPlace, IsNotClaimedOutsideTheRanges) {
  EXPECT_EQ(checked({kTall, "[-1, 0.6931]"}).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(checked({kTall, "[0.6932, 1.5]"}).verdict, Verdict::kNoSingularity);
  EXPECT_NE(checked({kTall, "[-1, 0.6931471805599]"}).verdict, Verdict::kSingularity);
  EXPECT_NE(checked({kTall, "[0.6931471806, 1.5]"}).verdict, Verdict::kSingularity);
  EXPECT_EQ(checked({kTall, "[-1, 0.6931471807]"}).verdict, Verdict::kSingularity);
}

TEST(EnclosedPlace, IsWithinTheConstraints) {
  Asked asked{kTall};
  asked.rest = "constraints = [\"x - 0.6932\"]\n";
  EXPECT_EQ(checked(asked).verdict, Verdict::kSingularity);
  asked.rest = "constraints = [\"x - 0.6931\"]\n";
  EXPECT_NE(checked(asked).verdict, Verdict::kSingularity);
  asked.rest = "constraints = [\"y - 0.85 + (x - 0.5)*1e-9\"]\n";
  EXPECT_NE(checked(asked).verdict, Verdict::kSingularity);
}

/// y = 0.85·a, which is in the range for the least values of a alone: a corner of 1e-6.
TEST(EnclosedPlace, MayBeAtTheEndOfARange) {
  Asked asked{R"~([["exp(x)", "2"], ["2", "2"], ["y*exp(x)", "1.7*a"]])~"};
  asked.constants = "a = { value = 1.57941, tolerance = 0.05 }\n";
  EXPECT_EQ(checked(asked).reason, Reason::kNullVector);
  asked.constants = "a = { value = 1.579413, tolerance = 0.05 }\n";
  EXPECT_NE(checked(asked).verdict, Verdict::kSingularity);
}

/// SINGULARITY is about some value of an uncertain quantity, which may be what is solved for.
TEST(EnclosedPlace, MayChooseUncertainQuantities) {
  Asked asked{R"~([["exp(x)", "2"], ["2", "2"], ["a*exp(x)", "1.7"]])~"};
  asked.constants = "a = { value = 0.9, tolerance = 0.1 }\n";
  const Result result = checked(asked);
  ASSERT_EQ(result.reason, Reason::kNullVector);
  EXPECT_EQ(result.witness->points.at(0).chosen, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_NEAR(mid(result.witness->points.at(0).variables.at(2)), 0.85, 1e-10);
  asked.constants = "a = { value = 0.9, tolerance = 0.049 }\n";
  EXPECT_NE(checked(asked).verdict, Verdict::kSingularity);
}

TEST(EnclosedPlace, IsNotClaimedWhereTheRankIsAlmostLost) {
  for (const char* gap : {"1e-9", "1e-12", "1e-40"}) {
    const std::string g = gap;
    const std::string rows = "[[\"exp(x) - 2\", \"" + g + "\"], [\"-" + g +
                             "\", \"exp(x) - 2\"], [\"0\", \"y - 0.85\"]]";
    EXPECT_NE(checked({rows}).verdict, Verdict::kSingularity) << gap;
  }
}

TEST(EnclosedPlace, IsNotClaimedWhereADeterminantTouchesZero) {
  EXPECT_EQ(checked({R"~([["(exp(x) - 2)^2", "1"], ["0", "y"]])~"}).verdict,
            Verdict::kPossibleProblem);
  EXPECT_NE(checked({R"~([["(exp(x) - 2)^2 + 1e-18", "1"], ["0", "y"]])~"}).verdict,
            Verdict::kSingularity);
}

/// Two columns and two rows are left where the third takes no part: one variable is chosen.
TEST(EnclosedPlace, MayConcernFewColumns) {
  const Result result =
      checked({R"~([["exp(x)", "2", "0"], ["2", "2", "0"], ["0", "0", "1"], ["0", "0", "y"]])~"});
  ASSERT_EQ(result.reason, Reason::kNullVector);
  const WitnessPoint& point = result.witness->points.at(0);
  EXPECT_EQ(point.chosen, (std::vector<std::uint32_t>{0}));
  EXPECT_NEAR(mid(point.variables.at(0)), kX, 1e-10);
  EXPECT_EQ(point.null_vector.at(2), Interval(0.0));
}

TEST(EnclosedPlace, IsNotClaimedWhereTheModelIsUndefined) {
  EXPECT_NE(
      checked({R"~([["exp(x)*(exp(x) - 2)/(exp(x) - 2)", "2"], ["2", "2"], ["y*exp(x)", "1.7"]])~"})
          .verdict,
      Verdict::kSingularity);
}

}  // namespace
}  // namespace regulus::detail::enclosed_place
