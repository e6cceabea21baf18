// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/symbolic/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/symbolic/gough_model.hpp"

namespace regulus::codegen::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Explain, ShowsBothFormsOfAnEntryAndWhatTheyCost) {
  const std::string text = explain(robot_1());
  EXPECT_THAT(text, HasSubstr("(K·A)(1,1)"));
  EXPECT_THAT(text, HasSubstr("form 1, as written: k_1_1*(x + "));
  EXPECT_THAT(text, HasSubstr("occurrences: phi 24, psi 24, theta 12, x 6"));
  EXPECT_THAT(text, HasSubstr("form 2, horner: x*(k_1_1 + k_1_2 + k_1_3 + k_1_4 + k_1_5 + k_1_6)"));
  EXPECT_THAT(text, HasSubstr("occurrences: phi 4, psi 2, theta 1, x 1"));
  EXPECT_THAT(text, HasSubstr("1440 → 60"));
  EXPECT_THAT(text, HasSubstr("left_product         36 outputs"));
}

TEST(Explain, ShowsOneRowUnlessAskedForAll) {
  EXPECT_THAT(explain(robot_1()), Not(HasSubstr("(K·A)(2,1)")));
  ExplainOptions options;
  options.all_entries = true;
  EXPECT_THAT(explain(robot_1(), options), HasSubstr("(K·A)(6,6)"));
}

TEST(Explain, SaysWhatItCuts) {
  ExplainOptions options;
  options.longest = 40;
  EXPECT_THAT(explain(robot_1(), options), HasSubstr("characters more)"));
}

TEST(Explain, NamesConditionsAndUncertainties) {
  GoughOptions gough;
  gough.tolerance = GiNaC::numeric(1, 20);
  Model model = robot_1(gough);
  model.must_be_defined = {GiNaC::pow(model.pose[0].symbol, -1)};
  const std::string text = explain(model);
  EXPECT_THAT(text, HasSubstr("A1_1 is uncertain geometry"));
  EXPECT_THAT(text, HasSubstr("defined only where 1/x is"));
}

}  // namespace
}  // namespace regulus::codegen::test
