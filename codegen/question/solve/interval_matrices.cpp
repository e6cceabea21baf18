// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/interval_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace regulus::detail {

std::vector<Interval> product(std::span<const double> K, std::span<const Interval> matrix,
                              std::size_t n) {
  const std::size_t m = matrix.size() / n;
  std::vector<Interval> result(n * m, Interval(0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const Interval factor(K[i * n + j]);
      for (std::size_t k = 0; k < m; ++k) result[i * m + k] += factor * matrix[j * m + k];
    }
  return result;
}

bool is_near_unit(std::span<const Interval> A, std::span<const Interval> steps) {
  const std::size_t n = steps.size();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
      sum = add_ru(sum, mul_ru(mag(A[i * n + j] - Interval(i == j ? 1.0 : 0.0)), mag(steps[j])));
    if (!(sum < mag(steps[i]))) return false;
  }
  return true;
}

bool is_near_unit(std::span<const Interval> A, std::size_t n) {
  constexpr int kMostPowers = 8;
  constexpr double kLeastPart = 0x1p-20;
  std::vector<double> r(n, 1.0);
  for (int step = 0; step < kMostPowers; ++step) {
    std::vector<double> next(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        next[i] = add_ru(next[i], mul_ru(mag(A[i * n + j] - Interval(i == j ? 1.0 : 0.0)), r[j]));
    if (std::ranges::equal(next, r, std::less())) return true;
    const double largest = std::ranges::max(next);
    if (!std::isfinite(largest)) return false;
    std::ranges::transform(next, r.begin(), [&](double x) { return x / largest + kLeastPart; });
  }
  return false;
}

int sign_of_determinant(std::vector<Interval> a, std::size_t n) {
  int sign = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (mig(a[i * n + c]) > mig(a[pivot * n + c])) pivot = i;
    if (contains_zero(a[pivot * n + c])) return 0;
    if (pivot != c) sign = -sign;
    for (std::size_t j = c; j < n; ++j) std::swap(a[c * n + j], a[pivot * n + j]);
    if (certain_negative(a[c * n + c])) sign = -sign;
    for (std::size_t i = c + 1; i < n; ++i) {
      const Interval factor = a[i * n + c] / a[c * n + c];
      for (std::size_t j = c + 1; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[c * n + j];
    }
  }
  return sign;
}

}  // namespace regulus::detail
