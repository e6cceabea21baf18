// SPDX-License-Identifier: GPL-3.0-or-later
// det(A·V) = det(A), exactly, at points where every sine and cosine is rational.
#include "codegen/kernel/columns/column_operations.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/passes.hpp"
#include "tests/support/symbolic/exact_values.hpp"
#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

using Rationals = std::vector<cl_RA>;  // row-major

cl_RA exact_determinant(Rationals a, std::size_t n) {
  cl_RA result = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    while (pivot < n && zerop(a[pivot * n + c])) ++pivot;
    if (pivot == n) return 0;
    if (pivot != c) result = -result;
    for (std::size_t j = 0; j < n && pivot != c; ++j) std::swap(a[c * n + j], a[pivot * n + j]);
    result = result * a[c * n + c];
    for (std::size_t i = c + 1; i < n; ++i) {
      const cl_RA factor = a[i * n + c] / a[c * n + c];
      for (std::size_t j = c; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[c * n + j];
    }
  }
  return result;
}

/// Returns det AᵀA: the sum of the squares of all minors of full size (Cauchy and Binet).
cl_RA gram_determinant(const Rationals& a, std::size_t m, std::size_t n) {
  Rationals gram(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t r = 0; r < m; ++r)
        gram[i * n + j] = gram[i * n + j] + a[r * n + i] * a[r * n + j];
  return exact_determinant(gram, n);
}

Rationals values_of(const PolynomialMatrix& A, const AtomTable& atoms, ExactValues& values) {
  Rationals result;
  for (const Polynomial& entry : A.entries) result.push_back(values(collect(entry, atoms)));
  return result;
}

PolynomialMatrix random_matrix(int rows, int columns, std::mt19937_64& random, Expander& expander) {
  RandomExpressions expressions(random);
  PolynomialMatrix A{columns, {}};
  for (int e = 0; e < rows * columns; ++e)
    A.entries.push_back(expander.expand(expressions.polynomial(1)).value());
  return A;
}

ColumnOperation random_operation(int columns, std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int target = below(columns);
  AtomProduct multiplier(1 + random() % 2, u'\0');
  for (Atom& a : multiplier) a = static_cast<Atom>(below(6));
  std::sort(multiplier.begin(), multiplier.end());
  return {target, (target + 1 + below(columns - 1)) % columns, cl_RA(below(9) - 4) / 3 + 2,
          multiplier};
}

TEST(ColumnOperations, LeaveDeterminantsAsTheyAre) {
  std::mt19937_64 random(21);
  for (int n = 2; n <= 5; ++n)
    for (int m = n; m <= n + 1; ++m) {
      AtomTable atoms(variable_names(), point_names());
      Expander expander(atoms);
      PolynomialMatrix A = random_matrix(m, n, random, expander);
      ExactValues values(random);
      const auto rows = static_cast<std::size_t>(m), columns = static_cast<std::size_t>(n);
      const Rationals before = values_of(A, atoms, values);
      for (int repetition = 0; repetition < 4; ++repetition) apply(random_operation(n, random), A);
      const Rationals after = values_of(A, atoms, values);
      EXPECT_NE(before, after);
      EXPECT_EQ(gram_determinant(after, rows, columns), gram_determinant(before, rows, columns));
      if (m != n) continue;
      EXPECT_EQ(exact_determinant(after, columns), exact_determinant(before, columns));
    }
}

TEST(ColumnOperations, FoundInRandomMatricesSaveTermsAndNoDeterminant) {
  std::mt19937_64 random(22);
  int found = 0;
  for (int repetition = 0; repetition < 12; ++repetition) {
    AtomTable atoms(variable_names(), point_names());
    Expander expander(atoms);
    PolynomialMatrix A = random_matrix(3, 3, random, expander);
    // The search may undo this operation; the test is that nothing else changes.
    apply(random_operation(3, random), A);
    ExactValues values(random);
    const cl_RA before = exact_determinant(values_of(A, atoms, values), 3);
    const ShorteningOperations shorter = find_shortening_operations(
        A, [](Atom) { return true; }, 1000000);
    for (const ColumnOperation& operation : shorter.operations) apply(operation, A);
    EXPECT_EQ(exact_determinant(values_of(A, atoms, values), 3), before);
    EXPECT_TRUE(shorter.complete);
    if (!shorter.operations.empty()) {
      ++found;
      EXPECT_LT(shorter.terms_after, shorter.terms_before);
    }
  }
  EXPECT_GE(found, 6);
}

/// Checks a formulation with changed columns: the determinant, and the product K times the matrix.
void expect_determinant_of_model(const Formulation& f, std::mt19937_64& random) {
  ExactValues values(random);
  Rationals natural, kernel;
  for (const Expression& e : f.natural_matrix) natural.push_back(values(e));
  for (const Expression& e : f.matrix) kernel.push_back(values(e));
  EXPECT_NE(natural, kernel);
  const auto n = static_cast<std::size_t>(f.columns);
  EXPECT_EQ(exact_determinant(kernel, n), exact_determinant(natural, n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      cl_RA entry = 0;
      for (std::size_t p = 0; p < n; ++p)
        entry =
            entry + values(point(point_name(static_cast<int>(i) + 1, static_cast<int>(p) + 1))) *
                        kernel[p * n + j];
      EXPECT_EQ(values(in_row(f.left_product.first[j], static_cast<int>(i) + 1)), entry)
          << i << " " << j;
    }
}

TEST(ColumnOperations, OfAFormulationKeepTheModelsDeterminant) {
  std::mt19937_64 random(23);
  for (const Model& model : {robot_1(), robot_2()}) {
    FormulationOptions options;
    options.right_product = options.derivatives = false;
    options.columns = ColumnSearch::kSecondOrder;
    Motion motion = box_motion(model);
    for (std::size_t k = 0; k < 3; ++k) motion.parameters[k].range = {-15, 15};
    motion.parameters[2].range = {model.geometry[0].value == -9 ? 45 : 2800,
                                  model.geometry[0].value == -9 ? 50 : 3200};
    const Formulation f = formulate(model, motion, options);
    ASSERT_TRUE(f.column_trials.has_value());
    ASSERT_FALSE(f.column_trials->kept.empty());
    expect_determinant_of_model(f, random);
  }
}

/// Some functions only replace uncertain quantities of one row by nominal values. All functions
/// must belong to the same A·V.
TEST(ColumnOperations, AreTheSameInTheMatrixAndInItsExpansionAtNominalValues) {
  std::mt19937_64 random(24);
  const Model model = robot_1({GiNaC::numeric(1, 1000), false, false});
  FormulationOptions options;
  options.left_product = options.right_product = options.derivatives = false;
  options.expansion = ExpansionForm::kAtNominal;
  options.columns = ColumnSearch::kSecondOrder;
  Motion motion = box_motion(model);
  motion.parameters[0].range = motion.parameters[1].range = {-15, 15};
  motion.parameters[2].range = {45, 50};
  const Formulation f = formulate(model, motion, options);
  ASSERT_FALSE(f.column_trials->kept.empty());
  const auto nominal = [&](const Expression& e) -> std::optional<Expression> {
    for (std::size_t v = 0; v < f.variables.size(); ++v)
      if (e.kind() == ExpressionKind::kVariable && e.name() == f.variables[v].name &&
          f.expansion->row_of_variable[v] != Expansion::kNoRow)
        return f.expansion->nominal[v];
    return std::nullopt;
  };
  ExactValues values(random);
  const std::vector<Expression> matrix = substitute(f.matrix, nominal);
  for (std::size_t j = 0; j < 6; ++j) {
    cl_RA entry = 0;
    for (std::size_t p = 0; p < 6; ++p)
      entry =
          entry + values(point(point_name(1, static_cast<int>(p) + 1))) * values(matrix[p * 6 + j]);
    EXPECT_EQ(values(f.expansion->product.first[j]), entry) << j;
  }
}

}  // namespace
}  // namespace regulus::detail::test
