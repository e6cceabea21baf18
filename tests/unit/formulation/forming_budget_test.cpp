// SPDX-License-Identifier: GPL-3.0-or-later
// Forms expressions within a budget of counted work, and stops the work early.
#include <gtest/gtest.h>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/print.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/model/model.hpp"
#include "tests/support/symbolic/exact_values.hpp"

namespace regulus::detail::test {
namespace {

/// Makes a dense model: each entry is a product of sums of all variables.
Model dense(int order, int variables, int factors) {
  Model model;
  Motion motion;
  GiNaC::ex sum_of = 0;
  for (int v = 1; v <= variables; ++v) {
    const GiNaC::realsymbol x("x" + std::to_string(v));
    model.pose.push_back({x, x.get_name(), "1"});
    motion.parameters.push_back({x, x.get_name(), "1", {1, 2}});
    motion.pose.push_back(x);
    sum_of += x;
  }
  const auto n = static_cast<unsigned>(order);
  model.matrix = GiNaC::matrix(n, n);
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j) {
      GiNaC::ex entry = 3 * i + j + 1;
      for (int f = 0; f < factors; ++f) entry *= sum_of + i + 7 * j + f;
      model.matrix(static_cast<unsigned>(i), static_cast<unsigned>(j)) = entry;
    }
  model.motions.push_back(motion);
  return model;
}

FormulationOptions with_budget(std::uint64_t budget) {
  FormulationOptions options;
  options.forming_budget = budget;
  return options;
}

Formulation formed(const Model& model, const FormulationOptions& options,
                   const FormingWatch* watch = nullptr) {
  return formulate(model, model.motions.front(), options, watch);
}

std::string printed(const std::vector<Expression>& forms) {
  std::string text;
  for (const Expression& e : forms) text += to_string(e) + "\n";
  return text;
}

/// Expects that K·A, as formed, has the value that the model's own entries give.
void expect_exact_product(const Formulation& f) {
  std::mt19937_64 random(11);
  ExactValues values(random);
  for (int r = 0; r < f.columns; ++r)
    for (int c = 0; c < f.columns; ++c) {
      cln::cl_RA expected = 0;
      for (int j = 0; j < f.rows; ++j)
        expected = expected + values(point(point_name(r + 1, j + 1))) *
                                  values(f.natural_matrix[std::size_t(j * f.columns + c)]);
      EXPECT_EQ(values(in_row(f.left_product.first[std::size_t(c)], r + 1)), expected);
    }
}

TEST(FormingBudget, GivesTheFullFormsWhereItIsNotExceeded) {
  const Formulation f = formed(dense(2, 2, 2), {});
  EXPECT_EQ(f.detail, FormDetail::kFull);
  EXPECT_GT(f.work, 0U);
  EXPECT_FALSE(f.left_derivatives.empty());
  expect_exact_product(f);
}

TEST(FormingBudget, GivesLessDetailAndTheSameFunctionsBeyondIt) {
  const Model model = dense(3, 4, 3);
  const std::uint64_t all = formed(model, {}).work;
  const Formulation parts = formed(model, with_budget(all - 1));
  EXPECT_EQ(parts.detail, FormDetail::kSmallParts);
  EXPECT_LT(parts.work, all);
  expect_exact_product(parts);
  const Formulation written = formed(model, with_budget(1));
  EXPECT_EQ(written.detail, FormDetail::kAsWritten);
  EXPECT_TRUE(written.left_derivatives.empty());
  EXPECT_FALSE(written.expansion);
  expect_exact_product(written);
}

TEST(FormingBudget, CountsTheSameEachTime) {
  const Model model = dense(3, 3, 3);
  const std::uint64_t all = formed(model, {}).work;
  EXPECT_EQ(formed(model, {}).work, all);
  EXPECT_EQ(formed(model, with_budget(all)).detail, FormDetail::kFull);
  const FormulationOptions less = with_budget(all / 2);
  const Formulation first = formed(model, less), second = formed(model, less);
  EXPECT_EQ(first.detail, second.detail);
  EXPECT_EQ(first.work, second.work);
  EXPECT_EQ(printed(first.left_product.first), printed(second.left_product.first));
  EXPECT_EQ(printed(first.left_derivatives.first), printed(second.left_derivatives.first));
}

/// If multiplied out, the parts of this model have some ten thousand terms each.
TEST(FormingBudget, HoldsForAModelThatWouldTakeForLong) {
  const Formulation f = formed(dense(6, 8, 5), {});
  EXPECT_NE(f.detail, FormDetail::kFull);
  EXPECT_LE(f.work, kFormingBudget);
  expect_exact_product(f);
}

TEST(FormingBudget, IsStoppedFromOutside) {
  const Model model = dense(4, 6, 4);
  const std::atomic<bool> interrupted = true;
  FormingWatch watch;
  watch.interrupt = &interrupted;
  try {
    static_cast<void>(formed(model, {}, &watch));
    FAIL();
  } catch (const FormingStopped& stopped) {
    EXPECT_TRUE(stopped.interrupted);
  }
  FormingWatch late;
  late.deadline = FormingWatch::Clock::time_point::min();
  EXPECT_THROW(static_cast<void>(formed(model, {}, &late)), FormingStopped);
  const Formulation left = formulate_shape(model, model.motions.front());
  EXPECT_EQ(left.variables.size(), 6U);
  EXPECT_TRUE(left.matrix.empty());
}

/// No budget counts these stages.
TEST(FormingBudget, IsStoppedInTheMiddleOfSubstitutionAndLowering) {
  const Model model = dense(6, 8, 5);
  const Formulation f = formed(model, with_budget(1));
  for (const WorkStage stage : {WorkStage::kSubstitution, WorkStage::kLowering}) {
    std::atomic<bool> interrupted = false;
    std::uint64_t told = 0;
    FormingWatch watch;
    watch.interrupt = &interrupted;
    watch.progress = [&](WorkStage at, std::uint64_t work, std::uint64_t most) {
      EXPECT_EQ(at, stage);
      EXPECT_EQ(most, WorkMeter::kNoLimit);
      told = work;
      interrupted = true;
    };
    if (stage == WorkStage::kSubstitution)
      EXPECT_THROW(static_cast<void>(formed(model, {}, &watch)), FormingStopped);
    else
      EXPECT_THROW(static_cast<void>(lower(f, &watch)), FormingStopped);
    EXPECT_GT(told, 0U);
    EXPECT_LT(told, 5000U);
  }
}

TEST(FormingBudget, DoesNotStopWithoutAReason) {
  const Model model = dense(2, 2, 2);
  const FormingWatch watch;
  const Formulation f = formed(model, {}, &watch);
  EXPECT_EQ(printed(f.left_product.first), printed(formed(model, {}).left_product.first));
  EXPECT_EQ(identity(lower(f, &watch)), identity(lower(f)));
}

/// The stop is in the middle of the work, at a count that does not depend on the time.
TEST(FormingBudget, TellsHowFarItIsAndStopsThere) {
  const Model model = dense(4, 6, 4);
  std::atomic<bool> interrupted = false;
  std::uint64_t told = 0;
  FormingWatch watch;
  watch.interrupt = &interrupted;
  watch.progress = [&](WorkStage stage, std::uint64_t work, std::uint64_t most) {
    if (stage != WorkStage::kForming) return;
    EXPECT_GE(work, told);
    EXPECT_EQ(most, kFormingBudget);
    told = work;
    if (work > 20000) interrupted = true;
  };
  EXPECT_THROW(static_cast<void>(formed(model, {}, &watch)), FormingStopped);
  EXPECT_GT(told, 20000U);
  EXPECT_LT(told, 100000U);
}

}  // namespace
}  // namespace regulus::detail::test
