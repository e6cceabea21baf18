// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Explain, ShowsBothFormsOfAnEntryAndWhatTheyCost) {
  const std::string text = explain(robot_1()).text;
  EXPECT_THAT(text, HasSubstr("(K·A)(1,1)"));
  EXPECT_THAT(text, HasSubstr("form 1, as written: k_1_1*(x + "));
  EXPECT_THAT(text, HasSubstr("occurrences: phi 24, psi 24, theta 12, x 6"));
  EXPECT_THAT(text, HasSubstr("form 2, horner: x*(k_1_1 + k_1_2 + k_1_3 + k_1_4 + k_1_5 + k_1_6)"));
  EXPECT_THAT(text, HasSubstr("occurrences: phi 4, psi 2, theta 1, x 1"));
  EXPECT_THAT(text, HasSubstr("1440 → 60"));
  EXPECT_THAT(text, HasSubstr("left_product         36 outputs"));
}

TEST(Explain, ShowsOneRowUnlessAskedForAll) {
  EXPECT_THAT(explain(robot_1()).text, Not(HasSubstr("(K·A)(2,1)")));
  ExplainOptions options;
  options.all_entries = true;
  EXPECT_THAT(explain(robot_1(), options).text, HasSubstr("(K·A)(6,6)"));
}

TEST(Explain, SaysWhatItCuts) {
  ExplainOptions options;
  options.longest = 40;
  EXPECT_THAT(explain(robot_1(), options).text, HasSubstr("characters more)"));
}

TEST(Explain, NamesConditionsAndUncertainties) {
  GoughOptions gough;
  gough.tolerance = GiNaC::numeric(1, 20);
  Model model = robot_1(gough);
  model.must_be_defined = {GiNaC::pow(model.pose[0].symbol, -1)};
  const std::string text = explain(model).text;
  EXPECT_THAT(text, HasSubstr("A1_1 is uncertain geometry"));
  EXPECT_THAT(text, HasSubstr("defined only where 1/x is"));
}

/// Makes rows, of which one is 2^-60 times the other.
Model two_scales() {
  Model model;
  model.name = "two scales";
  Motion motion;
  const GiNaC::realsymbol x("x"), y("y");
  for (const GiNaC::realsymbol& s : {x, y}) {
    model.pose.push_back({s, s.get_name(), "1"});
    motion.parameters.push_back({s, s.get_name(), "1", {1, 2}});
    motion.pose.push_back(s);
  }
  const GiNaC::ex small = GiNaC::pow(GiNaC::ex(2), -60);
  model.matrix = GiNaC::matrix{{x, y}, {-y * small, x * small}};
  model.motions.push_back(motion);
  return model;
}

TEST(Explain, SaysByWhichPowersOfTwoAMatrixWasScaled) {
  const Model model = two_scales();
  const Explanation explained = explain(model, model.motions.front());
  ASSERT_EQ(explained.scaling.rows.size(), 2U);
  EXPECT_GT(explained.scaling.rows[1] - explained.scaling.rows[0], 50);
  EXPECT_THAT(explained.text, HasSubstr("Rows and columns times powers of two"));
  EXPECT_THAT(explained.text, HasSubstr("2 2^" + std::to_string(explained.scaling.rows[1])));
  EXPECT_THAT(explained.text, HasSubstr("det R·A·C = 2^" +
                                        std::to_string(explained.scaling.determinant_exponent())));
}

TEST(Explain, SaysNothingOfScalesWhereThereAreNone) {
  EXPECT_THAT(explain(robot_1()).text, Not(HasSubstr("powers of two")));
  const Explanation without_motion = explain(two_scales());
  EXPECT_TRUE(without_motion.scaling.empty());
  EXPECT_THAT(without_motion.text, Not(HasSubstr("powers of two")));
}

}  // namespace
}  // namespace regulus::detail::test
