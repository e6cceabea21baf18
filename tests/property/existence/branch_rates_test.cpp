// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives over a tube, against matrices within its enclosures.
#include "runtime/existence/branch_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {
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

/// Every matrix of an enclosure has its inverse, its determinant and its quotients in the results.
TEST(BranchRates, HoldThoseOfEachMatrix) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> entry(-2, 2), spread(0, 0.04), part(-1, 1);
  int tried = 0;
  for (int count = 0; count < 400; ++count) {
    const std::size_t n = 1 + random() % 5, d = 1 + random() % 3;
    std::vector<double> middle(n * n);
    for (double& x : middle) x = entry(random);
    const auto inverse = approx_inverse_of(middle, n);
    if (!inverse) continue;
    std::vector<Interval> A, B;
    for (const double x : middle) {
      const double r = spread(random);
      A.emplace_back(x - r, x + r);
    }
    for (std::size_t e = 0; e < n * d; ++e) {
      const double x = entry(random), r = spread(random);
      B.emplace_back(x - r, x + r);
    }
    std::vector<double> radius;
    for (std::size_t i = 0; i < n; ++i) radius.push_back(0.5 + std::fabs(part(random)));
    const BranchTube tube{{}, std::vector<double>(n, 0.0), {}, radius};
    const std::vector<Interval> zero(n, Interval(0.0));
    const TubeImage image = image_of(tube, {}, *inverse, {zero, A, {}});
    if (!has_one_solution(tube, image)) continue;
    ++tried;
    const BranchRates rates(tube, image, *inverse, A);
    const auto J = rates.derivatives(B, d), of_inverse = rates.inverse();
    const Interval det = rates.determinant();
    for (int sample = 0; sample < 12; ++sample) {
      const auto member = [&](const std::vector<Interval>& of) {
        std::vector<double> result;
        for (const Interval& x : of) {
          const double at = sample < 4 ? (random() % 2 == 0 ? 1 : -1) : part(random);
          result.push_back(mid(x) + at * (x.hi - mid(x)) * (1 - 1e-12));
        }
        return result;
      };
      const std::vector<double> a = member(A), b = member(B);
      const auto exact = approx_inverse_of(a, n);
      ASSERT_TRUE(exact);
      const auto holds = [](const Interval& x, double value) {
        const double room = 1e-10 * (1 + std::fabs(value));
        return x.lo <= value + room && value - room <= x.hi;
      };
      EXPECT_TRUE(holds(det, determinant_of(a, n)));
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k)
          EXPECT_TRUE(holds(of_inverse[i * n + k], (*exact)[i * n + k]));
        for (std::size_t k = 0; k < d; ++k) {
          double value = 0;
          for (std::size_t j = 0; j < n; ++j) value -= (*exact)[i * n + j] * b[j * d + k];
          EXPECT_TRUE(holds(J[i * d + k], value));
        }
      }
    }
  }
  EXPECT_GE(tried, 60);
}

}  // namespace
}  // namespace regulus
