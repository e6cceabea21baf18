// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/columns/column_operations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/kernel/formulation/explain.hpp"
#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Returns ±15 cm around a height of 47.5 cm, and as many degrees.
Motion wide_motion(const Model& model, const GiNaC::ex& degrees = 15) {
  Motion motion = box_motion(model);
  motion.parameters[0].range = motion.parameters[1].range = {-15, 15};
  motion.parameters[2].range = {45, 50};
  for (std::size_t k = 3; k < 6; ++k)
    motion.parameters[k].range = {-degrees * GiNaC::Pi / 180, degrees * GiNaC::Pi / 180};
  return motion;
}

FormulationOptions searched(ColumnSearch columns = ColumnSearch::kSecondOrder) {
  FormulationOptions options;
  options.left_product = options.derivatives = options.right_product = false;
  options.matrix_derivatives = false;
  options.expansion = ExpansionForm::kAtNominal;
  options.columns = columns;
  return options;
}

std::vector<std::string> words(const std::vector<AppliedOperation>& operations) {
  std::vector<std::string> result;
  for (const AppliedOperation& o : operations)
    result.push_back(std::to_string(o.target) + " += " + to_string(o.multiplier) + " * " +
                     std::to_string(o.source));
  return result;
}

TEST(ColumnOperations, MoveTheMomentsOfAPlatformToTheBase) {
  const Model model = robot_1();
  const Formulation f = formulate(model, wide_motion(model), searched());
  EXPECT_THAT(words(f.column_trials->tried),
              ElementsAre("3 += -z * 1", "3 += y * 2", "4 += z * 0", "4 += -x * 2", "5 += -y * 0",
                          "5 += x * 1"));
  EXPECT_LT(f.column_trials->radius_of_all, f.column_trials->radius);
  EXPECT_EQ(words(f.column_trials->kept), words(f.column_trials->tried));
  EXPECT_TRUE(f.column_trials->complete);
}

TEST(ColumnOperations, AreNotComparedWhereTheMotionIsCertifiedWhole) {
  const Model model = robot_1();
  const Formulation f = formulate(model, wide_motion(model, 1), searched());
  EXPECT_FALSE(f.column_trials->tried.empty());
  EXPECT_EQ(f.column_trials->halvings, 0);
  EXPECT_TRUE(f.column_trials->kept.empty());
  EXPECT_EQ(f.matrix.size(), 36u);
}

TEST(ColumnOperations, LeaveQuantitiesOfOneRowInTheirRow) {
  const Model model = robot_1({GiNaC::numeric(1, 1000), false, false});
  const Motion motion = wide_motion(model);
  const Formulation with = formulate(model, motion, searched());
  const Formulation without = formulate(model, motion, searched(ColumnSearch::kNone));
  ASSERT_FALSE(with.column_trials->kept.empty());
  EXPECT_EQ(with.expansion->row_of_variable, without.expansion->row_of_variable);
  EXPECT_FALSE(without.column_trials.has_value());
}

TEST(ColumnOperations, AreSoughtNoLongerThanTheBudgetLasts) {
  AtomTable atoms({"x", "y"}, {});
  Expander expander(atoms);
  PolynomialMatrix A{2, {}};
  for (const Expression& e : {variable("x"), variable("x") * variable("y"), variable("y"),
                              power(variable("y"), 2) + Expression(1)})
    A.entries.push_back(expander.expand(e).value());
  const auto any = [](Atom) { return true; };
  const ShorteningOperations all = find_shortening_operations(A, any, 1000);
  ASSERT_EQ(all.operations.size(), 2u);  // (x, xy; y, y² + 1) → (x, 0; y, 1) → (x, 0; 0, 1)
  EXPECT_EQ(all.terms_before, 5u);
  EXPECT_EQ(all.terms_after, 2u);
  EXPECT_TRUE(all.complete);
  const ShorteningOperations none = find_shortening_operations(A, any, 2);
  EXPECT_TRUE(none.operations.empty());
  EXPECT_FALSE(none.complete);
}

TEST(ColumnOperations, AreExplainedWithTheFiguresThatDecided) {
  const Model model = robot_1();
  ExplainOptions options;
  EXPECT_THAT(explain(model, wide_motion(model), options).text,
              Not(HasSubstr("Column operations")));
  options.formulation.columns = ColumnSearch::kSecondOrder;
  const std::string text = explain(model, wide_motion(model), options).text;
  EXPECT_THAT(text, HasSubstr("Column operations of determinant 1"));
  EXPECT_THAT(text, HasSubstr("column 4 += -z · column 2"));
  EXPECT_THAT(text, HasSubstr("kept: these; A stands for A·V in K·A below"));
  EXPECT_THAT(explain(model, wide_motion(model, 1), options).text,
              HasSubstr("not compared: A is likely to be certified as it is"));
}

}  // namespace
}  // namespace regulus::detail::test
