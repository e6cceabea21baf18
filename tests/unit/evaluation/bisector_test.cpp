// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/evaluation/bisector.hpp"

#include <gtest/gtest.h>

#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::Values;

/// det = 4 + a·x + b·y + c·u: the impact of a variable is its coefficient times its radius.
class BisectorTest : public ::testing::TestWithParam<bool> {
 protected:
  BisectorTest()
      : kernel_(3, 1, 1, [](const Values& x) {
          return Values{Interval(64.0) + x[0] + Interval(8.0) * x[1] + x[2]};
        }) {
    kernel_.with_uncertain(1);
    if (GetParam()) kernel_.with_derivatives([](const Values&) { return Values{1.0, 8.0, 1.0}; });
    problem_ = test::problem_over(kernel_, {{0, 16}, {0, 4}, {-32, 32}});
  }

  std::optional<std::size_t> choose(const Settings& settings, const Values& box) {
    const RowStructure structure;
    Batch batch(problem_, settings, structure);
    batch.clear();
    batch.load(0, box);
    batch.seal(1);
    return Bisector(problem_, settings).choose(batch, 0);
  }

  FunctionKernel kernel_;
  Problem problem_;
};

TEST_P(BisectorTest, WidestTakesTheLargestWidth) {
  Settings settings;
  settings.bisection = Bisection::kWidest;
  EXPECT_EQ(choose(settings, {{0, 2}, {0, 3}, {-32, 32}}), 1U);
  EXPECT_EQ(choose(settings, {{0, 4}, {0, 3}, {-32, 32}}), 0U);
}

TEST_P(BisectorTest, NeverSplitsAnIdleVariable) {
  problem_.idle = {0, 1, 0};
  for (const Bisection bisection : {Bisection::kWidest, Bisection::kWeighted, Bisection::kImpact}) {
    Settings settings;
    settings.bisection = bisection;
    settings.min_relative_width = 0.25;
    EXPECT_NE(choose(settings, {{0, 16}, {0, 4}, {0, 0}}), 1U);
    const Values narrow = {{0, 4}, {0, 4}, {0, 0}};
    EXPECT_EQ(choose(settings, narrow), std::nullopt);
    EXPECT_FALSE(Bisector(problem_, settings).splits(narrow));
    EXPECT_EQ(Bisector(problem_, settings).approx_relative_width(narrow), 0.25);
  }
}

TEST_P(BisectorTest, WeightedTakesTheLargestPartOfTheRange) {
  Settings settings;
  settings.bisection = Bisection::kWeighted;
  EXPECT_EQ(choose(settings, {{0, 4}, {0, 2}, {-32, 32}}), 1U);
  EXPECT_EQ(choose(settings, {{0, 12}, {0, 2}, {-32, 32}}), 0U);
}

TEST_P(BisectorTest, WeightedMultipliesByTheWeights) {
  Settings settings;
  settings.bisection = Bisection::kWeighted;
  settings.weights = {4, 1, 1};
  EXPECT_EQ(choose(settings, {{0, 4}, {0, 2}, {-32, 32}}), 0U);
  EXPECT_EQ(choose(settings, {{0, 1}, {0, 2}, {-32, 32}}), 1U);
}

TEST_P(BisectorTest, ImpactTakesWhatMattersMost) {
  Settings settings;
  EXPECT_EQ(choose(settings, {{0, 16}, {0, 4}, {-32, 32}}), 1U);
  EXPECT_EQ(choose(settings, {{0, 16}, {0, 1}, {-32, 32}}), 0U);
}

TEST_P(BisectorTest, SplitsUncertainQuantitiesOnlyAsVariables) {
  Settings settings;
  const Values box{{1, 1}, {1, 1}, {-32, 32}};
  EXPECT_EQ(choose(settings, box), std::nullopt);
  settings.uncertainty = Uncertainty::kVariables;
  EXPECT_EQ(choose(settings, box), 2U);
}

TEST_P(BisectorTest, StopsAtTheMinimumWidth) {
  Settings settings;
  settings.min_relative_width = 0.25;
  EXPECT_EQ(choose(settings, {{0, 4}, {0, 1}, {-32, 32}}), std::nullopt);
  EXPECT_EQ(choose(settings, {{0, 4.5}, {0, 1}, {-32, 32}}), 0U);
}

TEST_P(BisectorTest, StopsWhereNoDoubleLiesBetween) {
  Settings settings;
  settings.min_relative_width = 0.0;
  EXPECT_EQ(choose(settings, {{1, 1 + 0x1p-52}, {2, 2}, {-32, 32}}), std::nullopt);
  EXPECT_EQ(choose(settings, {{1, 1 + 0x1p-51}, {2, 2}, {-32, 32}}), 0U);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutDerivatives, BisectorTest, ::testing::Bool(),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace regulus::detail
