// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices with two groups of uncertain quantities in each row, and their products. The determinant
// is affine in each quantity, so over ranges it is least at their ends; over balls a descent comes
// close to where it is least.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/certificate_texts.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

class CoupledMatrix {
 public:
  static constexpr std::size_t kOrder = 2;

  CoupledMatrix(std::mt19937_64& random, bool in_balls) : in_balls_(in_balls) {
    std::uniform_int_distribution<std::size_t> size(in_balls ? 2 : 1, 3);
    first_ = size(random), second_ = size(random);
    std::uniform_int_distribution<int> numerator(-64, 64);
    const int curvature = std::uniform_int_distribution<int>(0, 2)(random);
    x_.resize(kOrder * kOrder * terms());
    for (std::size_t e = 0; e < x_.size(); ++e)
      x_[e] = std::ldexp(numerator(random), e % terms() < first_ + second_ ? -6 : -6 - curvature);
  }

  /// Returns a certificate in one leaf that no member within `range` is singular.
  [[nodiscard]] std::string certificate(double range) const {
    std::string uncertain, entries;
    const std::size_t count = kOrder * (first_ + second_);
    for (std::size_t u = 0; u < count; ++u)
      uncertain += "uncertain " + name(u) + " = 0 +- " + std::to_string(range) + "\n";
    for (std::size_t l = 0; l < kOrder && in_balls_; ++l) {
      uncertain += "ball" + names(l * (first_ + second_), first_) + "\n";
      uncertain += "ball" + names(l * (first_ + second_) + first_, second_) + "\n";
    }
    for (std::size_t l = 0; l < kOrder; ++l)
      for (std::size_t j = 0; j < kOrder; ++j) entries += "entry " + entry(l, j) + "\n";
    return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 2x2 matrix of the model "
           "is defined and has full rank at every pose and value of the " +
           std::to_string(count) +
           " uncertain quantities of the variety\nmodel by hand\nsha256 -\nmotion only\nalpha "
           "0\nparameter p in 0 : 0\n" +
           uncertain + "pose p = p\nmatrix 2 2\n" + entries + kOneLeaf;
  }

  /// Returns about the least determinant within `range`.
  [[nodiscard]] double least_determinant(double range, std::mt19937_64& random) const {
    double least = HUGE_VAL;
    std::vector<double> u(kOrder * (first_ + second_));
    if (!in_balls_) {
      for (std::size_t ends = 0; ends < std::size_t{1} << u.size(); ++ends) {
        for (std::size_t k = 0; k < u.size(); ++k) u[k] = (ends >> k & 1U) != 0 ? range : -range;
        least = std::min(least, determinant(u));
      }
      return least;
    }
    std::uniform_real_distribution<double> anywhere(-range, range);
    for (int start = 0; start < 30; ++start) {
      for (double& x : u) x = anywhere(random);
      for (int round = 0; round < 20; ++round)
        for (std::size_t l = 0; l < kOrder; ++l) {
          move_to_least(u, l * (first_ + second_), first_, range);
          move_to_least(u, l * (first_ + second_) + first_, second_, range);
        }
      least = std::min(least, determinant(u));
    }
    return least;
  }

 private:
  [[nodiscard]] std::size_t terms() const { return first_ + second_ + first_ * second_; }
  [[nodiscard]] static std::string name(std::size_t u) { return "u" + std::to_string(u); }
  [[nodiscard]] static std::string names(std::size_t begin, std::size_t count) {
    std::string result;
    for (std::size_t k = begin; k < begin + count; ++k) result += " " + name(k);
    return result;
  }
  [[nodiscard]] double coefficient(std::size_t l, std::size_t j, std::size_t term) const {
    return x_[(l * kOrder + j) * terms() + term];
  }

  [[nodiscard]] std::string entry(std::size_t l, std::size_t j) const {
    std::string text = l == j ? "1" : "0";
    const std::size_t begin = l * (first_ + second_);
    for (std::size_t k = 0; k < first_ + second_; ++k)
      text += " + (" + std::to_string(coefficient(l, j, k)) + ")*" + name(begin + k);
    for (std::size_t b = 0; b < second_; ++b)
      for (std::size_t a = 0; a < first_; ++a)
        text += " + (" + std::to_string(coefficient(l, j, first_ + second_ + b * first_ + a)) +
                ")*" + name(begin + a) + "*" + name(begin + first_ + b);
    return text;
  }

  [[nodiscard]] double determinant(const std::vector<double>& u) const {
    double A[kOrder][kOrder];
    for (std::size_t l = 0; l < kOrder; ++l)
      for (std::size_t j = 0; j < kOrder; ++j) {
        const double* const s = u.data() + l * (first_ + second_);
        const double* const t = s + first_;
        A[l][j] = l == j ? 1.0 : 0.0;
        for (std::size_t k = 0; k < first_ + second_; ++k) A[l][j] += coefficient(l, j, k) * s[k];
        for (std::size_t b = 0; b < second_; ++b)
          for (std::size_t a = 0; a < first_; ++a)
            A[l][j] += coefficient(l, j, first_ + second_ + b * first_ + a) * s[a] * t[b];
      }
    return A[0][0] * A[1][1] - A[0][1] * A[1][0];
  }

  void move_to_least(std::vector<double>& u, std::size_t begin, std::size_t size,
                     double range) const {
    std::fill_n(u.begin() + std::ptrdiff_t(begin), size, 0.0);
    const double before = determinant(u);
    std::vector<double> gradient(size);
    double squares = 1e-300;
    for (std::size_t k = 0; k < size; ++k) {
      u[begin + k] = 1.0;
      gradient[k] = determinant(u) - before;
      u[begin + k] = 0.0;
      squares += gradient[k] * gradient[k];
    }
    for (std::size_t k = 0; k < size; ++k) u[begin + k] = -range * gradient[k] / std::sqrt(squares);
  }

  const bool in_balls_;
  std::size_t first_ = 0, second_ = 0;
  std::vector<double> x_;
};

class CoupledRowsOfTheVerifier : public testing::TestWithParam<bool> {};

TEST_P(CoupledRowsOfTheVerifier, AreBoundedCloselyAndNeverBeyondTheTruth) {
  std::mt19937_64 random(41);
  verifier::Options one_box;
  one_box.max_boxes_per_leaf = 1;
  int close = 0, rounds = 0;
  const int all = trials(15, 60);
  while (rounds < all) {
    const CoupledMatrix matrix(random, GetParam());
    double regular = 0.0, singular = 4.0;
    if (matrix.least_determinant(singular, random) > 0.0) continue;
    for (int step = 0; step < 12; ++step) {
      const double middle = 0.5 * (regular + singular);
      (matrix.least_determinant(middle, random) > 0.0 ? regular : singular) = middle;
    }
    ++rounds;
    for (const double beyond : {1.001, 1.01, 1.05, 1.2})
      ASSERT_NE(verify_text(matrix.certificate(beyond * singular), one_box).outcome,
                Outcome::kVerified)
          << matrix.certificate(beyond * singular);
    close += verify_text(matrix.certificate(0.93 * regular), one_box).outcome == Outcome::kVerified;
  }
  EXPECT_GE(close, GetParam() ? all * 5 / 6 : all * 14 / 15);
}

INSTANTIATE_TEST_SUITE_P(Shapes, CoupledRowsOfTheVerifier, testing::Bool(), [](const auto& balls) {
  return std::string(balls.param ? "Balls" : "Ranges");
});

}  // namespace
}  // namespace regulus::detail::test
