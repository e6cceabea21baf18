// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives over a tube, against matrices within its enclosures.
#include "runtime/existence/branch_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

double determinant_of(std::vector<double> a, std::size_t n) {
  double product = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (std::fabs(a[i * n + c]) > std::fabs(a[pivot * n + c])) pivot = i;
    if (pivot != c) product = -product;
    for (std::size_t j = 0; j < n; ++j) std::swap(a[c * n + j], a[pivot * n + j]);
    product *= a[c * n + c];
    for (std::size_t i = c + 1; i < n; ++i)
      for (std::size_t j = n; j-- > c;) a[i * n + j] -= a[i * n + c] / a[c * n + c] * a[c * n + j];
  }
  return product;
}

using Matrix = std::vector<double>;

bool holds(const Interval& x, double value) {
  const double room = 1e-10 * (1 + std::fabs(value));
  return x.lo <= value + room && value - room <= x.hi;
}

/// Enclosures of A and B, with the test of a tube.
class Case {
 public:
  explicit Case(std::mt19937& random)
      : random_(random), n_(1 + random() % 5), d_(1 + random() % 3) {
    Matrix middle(n_ * n_);
    for (double& x : middle) x = entry_(random);
    A_ = around(middle);
    inverse_ = approx_inverse_of(middle, n_);
    Matrix of_right(n_ * d_);
    for (double& x : of_right) x = entry_(random);
    B_ = around(of_right);
    tube_ = {{}, Matrix(n_, 0.0), {}, {}};
    for (std::size_t i = 0; i < n_; ++i) tube_.radius.push_back(0.5 + std::fabs(part_(random)));
    if (!inverse_) return;
    const std::vector<Interval> zero(n_, Interval(0.0));
    image_ = image_of(tube_, {}, *inverse_, {zero, A_, {}});
  }

  [[nodiscard]] bool has_test() const { return inverse_ && has_one_solution(tube_, image_); }

  /// Compares with matrices at corners of the enclosures, and within them.
  void compare() {
    const BranchRates rates(tube_, image_, *inverse_, A_);
    const auto J = rates.derivatives(B_, d_), of_inverse = rates.inverse();
    const Interval det = rates.determinant();
    for (int sample = 0; sample < 12; ++sample) {
      const Matrix a = member(A_, sample < 4), b = member(B_, sample < 4);
      const auto exact = approx_inverse_of(a, n_);
      ASSERT_TRUE(exact);
      EXPECT_TRUE(holds(det, determinant_of(a, n_)));
      for (std::size_t e = 0; e < n_ * n_; ++e) EXPECT_TRUE(holds(of_inverse[e], (*exact)[e]));
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t k = 0; k < d_; ++k) {
          double value = 0;
          for (std::size_t j = 0; j < n_; ++j) value -= (*exact)[i * n_ + j] * b[j * d_ + k];
          EXPECT_TRUE(holds(J[i * d_ + k], value));
        }
    }
  }

 private:
  std::vector<Interval> around(const Matrix& middle) {
    std::vector<Interval> result;
    for (const double x : middle) {
      const double r = spread_(random_);
      result.emplace_back(x - r, x + r);
    }
    return result;
  }
  Matrix member(const std::vector<Interval>& of, bool is_corner) {
    Matrix result;
    for (const Interval& x : of) {
      const double at = is_corner ? (random_() % 2 == 0 ? 1 : -1) : part_(random_);
      result.push_back(mid(x) + at * (x.hi - mid(x)) * (1 - 1e-12));
    }
    return result;
  }

  std::mt19937& random_;
  std::uniform_real_distribution<double> entry_{-2, 2}, spread_{0, 0.04}, part_{-1, 1};
  const std::size_t n_, d_;
  std::vector<Interval> A_, B_;
  std::optional<Matrix> inverse_;
  BranchTube tube_;
  TubeImage image_;
};

/// Every matrix of an enclosure has its inverse, its determinant and its quotients in the results.
TEST(BranchRates, HoldThoseOfEachMatrix) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(11);
  int tried = 0;
  for (int count = 0; count < 400; ++count) {
    Case one(random);
    if (!one.has_test()) continue;
    ++tried;
    one.compare();
  }
  EXPECT_GE(tried, 60);
}

}  // namespace
}  // namespace regulus::detail
