// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the closed form with exact elimination, and its derivatives with the chain rule, at
// points where every sine and cosine is rational.
#include "codegen/kernel/symbolic/determinant.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/module_check.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/passes.hpp"
#include "tests/support/symbolic/exact_values.hpp"
#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

/// Returns the determinant by exact elimination.
cl_RA eliminated(std::vector<cl_RA> a, std::size_t n) {
  cl_RA result = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    while (pivot < n && zerop(a[pivot * n + c])) ++pivot;
    if (pivot == n) return 0;
    if (pivot != c) {
      result = -result;
      for (std::size_t j = 0; j < n; ++j) std::swap(a[c * n + j], a[pivot * n + j]);
    }
    result = result * a[c * n + c];
    for (std::size_t i = c + 1; i < n; ++i) {
      const cl_RA factor = a[i * n + c] / a[c * n + c];
      for (std::size_t j = c; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[c * n + j];
    }
  }
  return result;
}

FormulationOptions closed_form() {
  FormulationOptions options;
  options.left_product = options.right_product = options.derivatives = false;
  options.determinant = true;
  return options;
}

TEST(Determinant, OfRandomMatricesIsThatOfElimination) {
  std::mt19937_64 random(11);
  for (int n = 1; n <= 5; ++n)
    for (int repetition = 0; repetition < 6; ++repetition) {
      AtomTable atoms(variable_names(), point_names());
      Expander expander(atoms);
      RandomExpressions expressions(random);
      Expressions entries;
      std::vector<Polynomial> polynomials;
      for (int e = 0; e < n * n; ++e) {
        // Zeros give columns of different lengths, so that the algorithm permutes them.
        entries.push_back(random() % 3 == 0 ? Expression(0) : expressions.polynomial(1));
        polynomials.push_back(expander.expand(entries.back()).value());
      }
      DeterminantBudget budget(10000000);
      const Expression form = collect(determinant(polynomials, n, atoms, budget), atoms);
      ExactValues values(random);
      std::vector<cl_RA> a;
      for (const Expression& e : entries) a.push_back(values(e));
      EXPECT_EQ(values(form), eliminated(a, static_cast<std::size_t>(n))) << n;
    }
}

TEST(Determinant, OfBothRobotsIsThatOfElimination) {
  for (const Model& model : {robot_1(), robot_2()}) {
    const Formulation f = formulate(model, box_motion(model), closed_form());
    ASSERT_EQ(f.determinant.size(), 1u);
    std::mt19937_64 random(3);
    for (int repetition = 0; repetition < 5; ++repetition) {
      ExactValues values(random);
      std::vector<cl_RA> a;
      for (const Expression& e : f.natural_matrix) a.push_back(values(e));
      EXPECT_EQ(values(f.determinant[0]), eliminated(a, 6));
    }
  }
}

TEST(Determinant, HasTheDerivativesOfTheChainRule) {
  const Model model = robot_1();
  const Formulation f = formulate(model, box_motion(model), closed_form());
  ASSERT_EQ(f.determinant_derivatives.size(), 6u);
  std::mt19937_64 random(5);
  for (std::size_t k = 0; k < 6; ++k) {
    const Expression expected = Differentiator(f.variables[k].name).derivative(f.determinant[0]);
    ExactValues values(random);
    EXPECT_EQ(values(f.determinant_derivatives[k]), values(expected)) << f.variables[k].name;
  }
}

TEST(Determinant, CountsTheSameTermsWhateverTheOrderOfSymbols) {
  GoughOptions shuffled;
  shuffled.shuffled_symbols = true;
  const Model one = robot_1(), other = robot_1(shuffled);
  const auto terms = [](const Model& model) {
    return formulate(model, box_motion(model), closed_form()).determinant_terms;
  };
  EXPECT_EQ(terms(one), terms(other));
  EXPECT_GT(terms(one), 1000u);
}

TEST(Determinant, IsRefusedByOneTermLessThanItTakes) {
  const Model model = robot_1();
  FormulationOptions options = closed_form();
  options.determinant_budget = formulate(model, box_motion(model), closed_form()).determinant_terms;
  EXPECT_NO_THROW(static_cast<void>(formulate(model, box_motion(model), options)));
  --options.determinant_budget;
  EXPECT_THROW(static_cast<void>(formulate(model, box_motion(model), options)), ClosedFormError);
}

TEST(Determinant, OfSymbolicAnchorsIsRefusedByTheDefaultBudget) {
  GoughOptions uncertain;
  uncertain.tolerance = GiNaC::numeric(1, 100);
  const Model model = robot_1(uncertain);
  EXPECT_THROW(static_cast<void>(formulate(model, box_motion(model), closed_form())),
               ClosedFormError);
}

TEST(Determinant, OfAMatrixWithMoreRowsThanColumnsIsRefused) {
  const GiNaC::realsymbol x("x");
  Model model;
  model.pose = {{x, "x", "1"}};
  model.matrix = GiNaC::matrix{{x}, {x + 1}};
  EXPECT_THROW(static_cast<void>(formulate(model, box_motion(model), closed_form())),
               ClosedFormError);
}

TEST(Determinant, IsAFunctionOfTheModule) {
  const Model model = robot_1();
  const Module module = lower(formulate(model, box_motion(model), closed_form()));
  check_module(module);
  ASSERT_NE(module.find("determinant"), nullptr);
  EXPECT_EQ(module.find("determinant")->program.outputs.size(), 1u);
  EXPECT_EQ(module.find("determinant_derivatives")->program.outputs.size(), 6u);
}

}  // namespace
}  // namespace regulus::detail::test
