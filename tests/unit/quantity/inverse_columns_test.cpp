// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/inverse_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/quantity/sample_point.hpp"

namespace regulus::detail::test {
namespace {

using GiNaC::matrix;

Request request_of(const std::string& rows, const std::string& range) {
  const std::string text =
      "regulus = 1\nname = \"m\"\n[pose]\nx = \"1\"\n[geometry]\na = { value = 2, tolerance = 0.1 "
      "}\n"
      "[matrix]\nrows = " +
      rows + "\n[motion.m]\nx = " + range + "\n";
  Model model = parse_model(text, "model.toml");
  Motion motion = model.motions.front();
  return {std::move(model), std::move(motion)};
}

std::optional<matrix> columns_of(const Request& request) {
  return inverse_columns(request, request.model.matrix);
}

/// Expects AᵀC = [I 0] at x, a = 2, but for the digits that C does not have.
void expect_inverse(const Request& request, double x) {
  const std::optional<matrix> C = columns_of(request);
  ASSERT_TRUE(C);
  const matrix& A = request.model.matrix;
  EXPECT_FALSE(C->determinant().is_zero());
  GiNaC::exmap point;
  point[request.model.pose[0].symbol] = x;
  point[request.model.geometry[0].symbol] = 2;
  const matrix product = A.transpose().mul(*C);
  for (unsigned i = 0; i < product.rows(); ++i)
    for (unsigned k = 0; k < product.cols(); ++k)
      EXPECT_NEAR(approx_number(product(i, k).subs(point)), i == k ? 1 : 0, 0.01) << i << " " << k;
}

TEST(InverseColumns, InvertTheMatrixInTheMiddle) {
  expect_inverse(request_of(R"([["x", "a"], ["1", "3*x"]])", "[0.5, 1.5]"), 1);
}

TEST(InverseColumns, HaveTheDirectionsThatATallMatrixLacks) {
  expect_inverse(request_of(R"([["x", "a"], ["1", "3"], ["a", "-x"]])", "[0.5, 1.5]"), 1);
}

TEST(InverseColumns, ComeFromAnotherPlaceIfTheMiddleHasNone) {
  for (const char* entry : {"x", "1/x", "sqrt(x)"}) {
    const Request request =
        request_of(std::string("[[\"") + entry + R"(", "0"], ["1", "a"]])", "[-1, 1]");
    const std::optional<matrix> C = columns_of(request);
    ASSERT_TRUE(C) << entry;
    EXPECT_FALSE(C->determinant().is_zero());
  }
}

TEST(InverseColumns, AreNoneOfAMatrixThatIsSingularEverywhere) {
  EXPECT_FALSE(columns_of(request_of(R"([["x", "2*x"], ["a", "2*a"]])", "[1, 2]")));
  EXPECT_FALSE(columns_of(request_of(R"([["0", "2*x"], ["0", "a"]])", "[1, 2]")));
  EXPECT_FALSE(columns_of(request_of(R"m([["sqrt(-1 - x^2)"]])m", "[1, 2]")));
}

TEST(InverseColumns, AreTheSameInEveryRun) {
  const Request request = request_of(R"m([["sqrt(x)", "0"], ["1", "a"]])m", "[-1, 1]");
  EXPECT_TRUE(*columns_of(request) == *columns_of(request));
}

}  // namespace
}  // namespace regulus::detail::test
