// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix of factors against the determinant that it stands for.
#include "codegen/model/mechanism/determinant_factors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/evaluate.hpp"

namespace regulus::detail::test {
namespace {

using GiNaC::ex;
using GiNaC::matrix;
using testing::IsEmpty;
using testing::SizeIs;

/// Laplace's expansion, which shares nothing with the code under test.
double determinant_at(const matrix& A, const Point& point) {
  const unsigned n = A.rows();
  if (n == 1) return evaluate(A(0, 0), point);
  double sum = 0;
  for (unsigned j = 0; j < n; ++j) {
    if (A(0, j).is_zero()) continue;
    matrix minor(n - 1, n - 1);
    for (unsigned i = 1; i < n; ++i)
      for (unsigned k = 0; k + 1 < n; ++k) minor(i - 1, k) = A(i, k < j ? k : k + 1);
    sum += (j % 2 == 0 ? 1 : -1) * evaluate(A(0, j), point) * determinant_at(minor, point);
  }
  return sum;
}

struct Determinants {
  double most = 0, difference = 0;
};

/// At random poses, with random values of the uncertain lengths.
Determinants compare(const Model& model) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-3, 3), part(0.9, 1.1);
  Determinants result;
  for (int pose = 0; pose < 20; ++pose) {
    Point point;
    for (const GeometryParameter& g : model.geometry)
      point[g.name] = evaluate(g.value, {}) * part(random);
    for (const PoseParameter& p : model.pose) point[p.name] = angle(random);
    const double own = determinant_at(model.jacobian.value_or(model.matrix), point);
    result.most = std::max(result.most, std::fabs(own));
    result.difference =
        std::max(result.difference, std::fabs(own - determinant_at(model.matrix, point)));
  }
  return result;
}

Model arm(const std::string& serial) {
  std::string motion = "\n[motion.zero]\n";
  for (int j = 1; j <= 6; ++j) motion += "q" + std::to_string(j) + " = 0\n";
  return parse_model("regulus = 1\nname = \"arm\"\n[serial]\n" + serial + motion, "arm.toml");
}

/// Returns the Puma, whose last three axes meet. `more`: keys of [serial].
std::string spherical_wrist(const std::string& more = {}) {
  return more +
         "convention = \"modified-dh\"\njoints = [{ name = \"q1\" },\n"
         "{ name = \"q2\", alpha = \"-pi/2\", d = 0.2435 },\n"
         "{ name = \"q3\", a = 0.4318, d = -0.0934 },\n"
         "{ name = \"q4\", a = -0.0203, alpha = \"pi/2\", d = 0.4331 },\n"
         "{ name = \"q5\", alpha = \"-pi/2\" }, { name = \"q6\", alpha = \"pi/2\" }]\n";
}

constexpr const char* kParallelAxes =
    "convention = \"standard-dh\"\njoints = [{ name = \"q1\", alpha = \"pi/2\", d = 0.1 },\n"
    "{ name = \"q2\", a = -0.4 }, { name = \"q3\", a = -0.35 },\n"
    "{ name = \"q4\", alpha = \"pi/2\", d = 0.11 }, { name = \"q5\", alpha = \"-pi/2\", d = 0.09 "
    "},\n"
    "{ name = \"q6\", d = 0.08 }]\n";

std::size_t joints_that_occur(const Model& model) {
  std::size_t count = 0;
  for (const PoseParameter& p : model.pose) {
    bool occurs = false;
    for (unsigned i = 0; i < model.matrix.rows(); ++i)
      for (unsigned j = 0; j < model.matrix.cols(); ++j)
        occurs = occurs || model.matrix(i, j).has(p.symbol);
    count += occurs ? 1 : 0;
  }
  return count;
}

bool is_diagonal(const matrix& A) {
  for (unsigned i = 0; i < A.rows(); ++i)
    for (unsigned j = 0; j < A.cols(); ++j)
      if (i != j && !A(i, j).is_zero()) return false;
  return true;
}

TEST(DeterminantFactors, TakeThePlaceOfASphericalWrist) {
  const Model model = arm(spherical_wrist());
  ASSERT_TRUE(model.jacobian.has_value());
  EXPECT_TRUE(is_diagonal(model.matrix));
  EXPECT_EQ(joints_that_occur(model), 3U) << "q2, q3 and q5";
  const Determinants both = compare(model);
  EXPECT_GT(both.most, 0.01);
  EXPECT_LT(both.difference, 1e-14);
}

TEST(DeterminantFactors, TakeThePlaceOfThreeParallelAxes) {
  const Model model = arm(kParallelAxes);
  ASSERT_TRUE(model.jacobian.has_value());
  EXPECT_TRUE(is_diagonal(model.matrix));
  EXPECT_EQ(joints_that_occur(model), 4U) << "q2, q3, q4 and q5";
  const Determinants both = compare(model);
  EXPECT_GT(both.most, 0.01);
  EXPECT_LT(both.difference, 1e-14);
}

TEST(DeterminantFactors, HoldForUncertainLengths) {
  const Model model = arm(spherical_wrist("length_tolerance = 0.001\n"));
  const Determinants both = compare(model);
  EXPECT_GT(both.most, 0.01);
  EXPECT_LT(both.difference, 1e-14);
}

TEST(DeterminantFactors, HoldForUncertainAngles) {
  const Model model = arm(spherical_wrist("angle_tolerance = 0.001\n"));
  EXPECT_LT(compare(model).difference, 1e-14);
  EXPECT_FALSE(is_diagonal(model.matrix)) << "the axes need not meet";
}

/// A pose parameter that is an angle, and a matrix that contains it.
struct OneAngle {
  GiNaC::realsymbol q{"q"};
  std::vector<PoseParameter> pose{{q, "q", "rad"}};
  [[nodiscard]] std::vector<DeterminantBlock> blocks(const matrix& A) const {
    return determinant_blocks(A, pose);
  }
};

TEST(DeterminantFactors, KeepTheSignThatExchangesGive) {
  const OneAngle of;
  matrix A(3, 3);
  A(0, 2) = sin(of.q), A(1, 1) = cos(of.q), A(2, 0) = 2;
  const auto product = matrix_of_factors(of.blocks(A));
  ASSERT_TRUE(product.has_value());
  const Point point{{"q", 0.3}};
  EXPECT_NEAR(determinant_at(*product, point), -2 * std::sin(0.3) * std::cos(0.3), 1e-15);
  EXPECT_NEAR(determinant_at(*product, point), determinant_at(A, point), 1e-15);
}

TEST(DeterminantFactors, CountTheirPowers) {
  const OneAngle of;
  matrix A(2, 2);
  A(0, 0) = pow(sin(of.q), 2), A(0, 1) = 1, A(1, 0) = 0, A(1, 1) = 3 * sin(of.q);
  matrix dense(2, 2);  // the same determinant, in one block
  dense(0, 0) = A(0, 0) + 1, dense(0, 1) = 1, dense(1, 0) = 3 * sin(of.q),
           dense(1, 1) = 3 * sin(of.q);
  const auto blocks = of.blocks(dense);
  ASSERT_THAT(blocks, SizeIs(1));
  ASSERT_THAT(blocks[0].factors, SizeIs(1));
  EXPECT_EQ(blocks[0].factors[0].power, 3);
  const auto product = matrix_of_factors(blocks);
  ASSERT_TRUE(product.has_value());
  const Point point{{"q", 0.7}};
  EXPECT_NEAR(determinant_at(*product, point), 3 * std::pow(std::sin(0.7), 3), 1e-15);
}

/// 1 + cos(q) = 2/(1 + t²) has no zero in t = tan(q/2), and yet one at q = pi.
TEST(DeterminantFactors, HaveTheZerosAtInfinity) {
  const OneAngle of;
  matrix A(1, 1);
  A(0, 0) = 2 * pow(sin(of.q), 2) + 2 * sin(of.q) * cos(of.q) * sin(of.q);
  const auto blocks = of.blocks(A);
  ASSERT_THAT(blocks, SizeIs(1));
  ASSERT_TRUE(blocks[0].is_factored);
  const auto product = matrix_of_factors(blocks);
  ASSERT_TRUE(product.has_value());
  for (const double q : {0.4, 3.0, -2.0}) {
    const double s = std::sin(q);
    EXPECT_NEAR(determinant_at(*product, {{"q", q}}), 2 * s * s * (1 + std::cos(q)), 1e-15);
  }
}

TEST(DeterminantFactors, AreNotClaimedOfAMatrixThatIsAlwaysSingular) {
  const OneAngle of;
  matrix A(2, 2);
  A(0, 0) = sin(of.q), A(0, 1) = cos(of.q), A(1, 0) = 2 * sin(of.q), A(1, 1) = 2 * cos(of.q);
  const auto blocks = of.blocks(A);
  ASSERT_THAT(blocks, SizeIs(1));
  EXPECT_FALSE(blocks[0].is_factored);
}

TEST(DeterminantFactors, AreOnlyThoseOfSquareMatrices) {
  const OneAngle of;
  EXPECT_THAT(of.blocks(matrix(3, 2)), IsEmpty());
}

}  // namespace
}  // namespace regulus::detail::test
