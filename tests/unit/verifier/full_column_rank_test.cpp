// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the proof of full column rank, by exact algebra and by elimination.
#include <gtest/gtest.h>

#include <random>

#include "runtime/verifier/linear_algebra.hpp"
#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Ball;
using verifier::Outcome;

/// Verifies that a matrix of `size`, "3x2", has full rank over x in `range` and y in [1, 3/2].
Outcome of(const std::string& size, const std::vector<std::string>& entries,
           const std::string& range = "-1 : 1") {
  std::string text =
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full " + size +
      " matrix of the model is defined and has full rank at every pose of the variety\nmodel by "
      "hand\nsha256 -\nmotion only\nalpha 0\nparameter x in " +
      range + "\nparameter y in 1 : 3/2\npose x = x\npose y = y\nmatrix " + size + '\n';
  text[text.rfind('x')] = ' ';
  for (const std::string& entry : entries) text += "entry " + entry + '\n';
  return verify_text(text + kOneLeaf).outcome;
}

std::string with(std::string text, const std::string& margin) {
  for (std::size_t at; (at = text.find('#')) != std::string::npos;) text.replace(at, 1, margin);
  return text;
}

TEST(RowsThatAreMultiplesOfOne, AreVerifiedDownToAnyMargin) {
  for (const char* margin : {"1e-6", "1e-17", "1e-60", "1e-300"})
    EXPECT_EQ(of("3x1", {with("x^2 + #", margin), with("3*x^2 + 3*#", margin), "0"}),
              Outcome::kVerified)
        << margin;
  EXPECT_NE(of("3x1", {"x^2", "3*x^2", "0"}), Outcome::kVerified);
  EXPECT_NE(of("3x1", {"x^2 - 1e-60", "3*x^2 - 3e-60", "0"}), Outcome::kVerified);
}

TEST(RowsThatVanishAtDifferentPoses, AreVerifiedHoweverClose) {
  for (const char* gap : {"1/10", "1e-12", "1e-40", "1e-300"}) {
    EXPECT_EQ(of("2x1", {"x", with("x - #", gap)}), Outcome::kVerified) << gap;
    EXPECT_EQ(of("3x2", {"x", "2*x", with("x - #", gap), with("2*x - 2*#", gap), "3", "7"}),
              Outcome::kVerified)
        << gap;
  }
  EXPECT_NE(of("2x1", {"x", "2*x"}), Outcome::kVerified);
  EXPECT_NE(of("3x2", {"x", "2*x", "5*x", "10*x", "3", "7"}), Outcome::kVerified);
}

/// Returns rows: the last two combine the first two, whose determinant is x² + margin.
std::vector<std::string> combinations(const std::string& margin) {
  std::vector<std::string> entries{"1", "y", "x", with("x*y + x^2 + #", margin)};
  for (const char* factor : {"3", "-2"}) {
    entries.push_back(with("1 + #*x", factor));
    entries.push_back("y + " + std::string(factor) + "*(" + entries[3] + ")");
  }
  return entries;
}

TEST(RowsThatAreCombinations, AreVerifiedByOneMinor) {
  EXPECT_EQ(of("4x2", combinations("1e-50")), Outcome::kVerified);
  EXPECT_NE(of("4x2", combinations("0")), Outcome::kVerified);
  EXPECT_NE(of("4x2", combinations("(-1e-50)")), Outcome::kVerified);
}

TEST(AMatrixWithMoreRowsThanColumns, HasNoValueWhereAnEntryHasNone) {
  EXPECT_EQ(of("2x1", {"x^2 + 1e-30 + (x - 2)/(x - 2)", "1"}), Outcome::kVerified);
  EXPECT_NE(of("2x1", {"x^2 + 1e-30 + x/x", "1"}), Outcome::kVerified);
}

TEST(ColumnsThatDepend, AreNeverVerified) {
  EXPECT_NE(of("3x2", {"x", "2*x", "1 + y", "2 + 2*y", "x*y", "2*x*y"}), Outcome::kVerified);
  EXPECT_NE(of("3x2", {"1", "sin(x)^2 + cos(x)^2", "y", "y", "x", "x"}), Outcome::kVerified);
}

/// Exact algebra does not know the relation atan(1/2) + atan(1/3) = π/4.
TEST(AMatrixThatDoesNotMove, IsVerifiedByElimination) {
  const char* const kZero = "atan(1/2) + atan(1/3) - pi/4";
  const std::string small = kZero + std::string(" + 1e-60");
  EXPECT_EQ(of("3x2", {"1", "1", "1", "1 + " + small, "1", "1"}, "1 : 1"), Outcome::kVerified);
  EXPECT_NE(of("3x2", {"1", "1", "1", std::string("1 + ") + kZero, "1", "1"}, "1 : 1"),
            Outcome::kVerified);
}

TEST(ALeftInverse, IsAsGoodAsTheConditionAllows) {
  // The condition is 1e9; AᵀA would have 1e18.
  const std::vector<double> A{1, 1, 1, 1 + 1e-9, 1, 1 - 1e-9};
  verifier::Matrix K;
  ASSERT_TRUE(verifier::approx_left_inverse(A, 3, 2, K));
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      double sum = i == j ? -1 : 0;
      for (std::size_t row = 0; row < 3; ++row) sum += K[row * 2 + i] * A[row * 2 + j];
      EXPECT_LT(std::fabs(sum), 1e-5);
    }
  EXPECT_FALSE(verifier::approx_left_inverse({0, 1, 0, 2, 0, 3}, 3, 2, K));
}

/// A product of random integer matrices has at most the rank of the smaller one.
TEST(IndependentRows, AreNeverMoreThanTheRank) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> number(-3, 3), order(1, 5);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto columns = static_cast<std::size_t>(order(random)), rows = columns + 2;
    const std::size_t rank = static_cast<std::size_t>(order(random)) % (columns + 1);
    std::vector<double> left(rows * rank), right(rank * columns);
    for (double& x : left) x = number(random);
    for (double& x : right) x = number(random);
    std::vector<Ball> A;
    for (std::size_t e = 0; e < rows * columns; ++e) {
      double sum = 0;
      for (std::size_t k = 0; k < rank; ++k)
        sum += left[e / columns * rank + k] * right[k * columns + e % columns];
      A.emplace_back(verifier::point(sum / 4), 64);
    }
    EXPECT_LE(verifier::independent_rows(A, rows, columns, 64).size(), rank);
  }
}

TEST(IndependentRows, CountOnlyWhatHoldsForEveryMember) {
  const auto size = [](std::vector<verifier::Interval> entries) {
    std::vector<Ball> A;
    for (const verifier::Interval x : entries) A.emplace_back(x, 64);
    return verifier::independent_rows(A, 2, 2, 64).size();
  };
  EXPECT_EQ(size({{1, 2}, {0, 0.25}, {0, 0.25}, {1, 2}}), 2U);
  EXPECT_EQ(size({{1, 2}, {0, 1}, {0, 1}, {1, 2}}), 1U);
  EXPECT_EQ(size({{-1, 1}, {0, 0}, {0, 0}, {-1, 1}}), 0U);
}

}  // namespace
}  // namespace regulus::detail::test
