// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/branch_rates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regulus::detail {
namespace {

constexpr int kSteps = 3;           ///< of g ← Pg + c
constexpr int kStepsOfWeights = 8;  ///< of v ← Pv + a little of v
constexpr double kPartOfWeights = 0x1p-10;

/// Encloses the determinant of a matrix of doubles by elimination; unbounded if a pivot may be 0.
Interval determinant_of(std::span<const double> matrix, std::size_t n) {
  std::vector<Interval> a;
  for (const double x : matrix) a.emplace_back(x);
  Interval product(1.0);
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (mig(a[i * n + c]) > mig(a[pivot * n + c])) pivot = i;
    if (contains_zero(a[pivot * n + c])) return {-kInfinity, kInfinity};
    if (pivot != c) {
      for (std::size_t j = 0; j < n; ++j) std::swap(a[c * n + j], a[pivot * n + j]);
      product = -product;
    }
    product *= a[c * n + c];
    for (std::size_t i = c + 1; i < n; ++i) {
      const Interval factor = a[i * n + c] / a[c * n + c];
      for (std::size_t j = c; j < n; ++j) a[i * n + j] -= factor * a[c * n + j];
    }
  }
  return product;
}

}  // namespace

/// Computes x ≥ (I − P)⁻¹c, upward; infinite where none is found.
void BranchRates::bound_solution(std::span<const double> c, std::span<double> x) const {
  const auto image = [&](std::size_t i) {
    double sum = c[i];
    for (std::size_t j = 0; j < n_; ++j) sum = add_ru(sum, mul_ru(spread(i, j), x[j]));
    return sum;
  };
  std::ranges::copy(c, x.begin());
  std::vector<double> next(n_);
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t i = 0; i < n_; ++i) next[i] = image(i);
    std::ranges::copy(next, x.begin());
  }
  double beta = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double missing = sub_ru(image(i), x[i]);
    const double room = sub_rd(tube_.radius[i], image_.change[i]);
    if (missing <= 0) continue;
    beta = room > 0 ? std::fmax(beta, div_ru(missing, room)) : kInfinity;
  }
  for (std::size_t i = 0; i < n_; ++i) {
    x[i] = add_ru(x[i], mul_ru(beta, tube_.radius[i]));
    if (std::isnan(x[i])) x[i] = kInfinity;
  }
}

std::vector<Interval> BranchRates::derivatives(std::span<const Interval> B, std::size_t d) const {
  std::vector<Interval> result(n_ * d);
  std::vector<double> middle(n_), c(n_), x(n_);
  std::vector<Interval> column(n_);
  for (std::size_t k = 0; k < d; ++k) {
    for (std::size_t i = 0; i < n_; ++i) {
      middle[i] = 0;
      for (std::size_t j = 0; j < n_; ++j) middle[i] -= inverse_[i * n_ + j] * mid(B[j * d + k]);
      if (!std::isfinite(middle[i])) middle[i] = 0;
    }
    for (std::size_t j = 0; j < n_; ++j) {
      column[j] = B[j * d + k];
      for (std::size_t l = 0; l < n_; ++l)
        column[j] += by_unknown_[j * n_ + l] * Interval(middle[l]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      Interval sum(0.0);
      for (std::size_t j = 0; j < n_; ++j) sum += Interval(inverse_[i * n_ + j]) * column[j];
      c[i] = mag(sum);
    }
    bound_solution(c, x);
    for (std::size_t i = 0; i < n_; ++i)
      result[i * d + k] = Interval(middle[i]) + Interval(-x[i], x[i]);
  }
  return result;
}

std::vector<Interval> BranchRates::inverse() const {
  std::vector<Interval> minus_unit(n_ * n_, Interval(0.0));
  for (std::size_t i = 0; i < n_; ++i) minus_unit[i * n_ + i] = Interval(-1.0);
  return derivatives(minus_unit, n_);
}

Interval BranchRates::determinant() const {
  std::vector<double> v(tube_.radius), next(n_);
  const auto times = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t j = 0; j < n_; ++j) sum = add_ru(sum, mul_ru(spread(i, j), v[j]));
    return sum;
  };
  const auto largest_ratio = [&] {
    double ratio = 0;
    for (std::size_t i = 0; i < n_; ++i) ratio = std::fmax(ratio, times(i) / v[i]);
    return ratio;
  };
  std::vector<double> best = v;
  double least = largest_ratio();
  for (int step = 0; step < kStepsOfWeights; ++step) {
    double size = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      next[i] = times(i) + kPartOfWeights * least * v[i];
      size = std::fmax(size, next[i] / tube_.radius[i]);
    }
    if (!(size > 0) || !std::isfinite(size)) break;
    for (std::size_t i = 0; i < n_; ++i) v[i] = next[i] / size;
    if (const double ratio = largest_ratio(); ratio < least) best = v, least = ratio;
  }
  v = best;
  Interval factor(1.0);
  for (std::size_t i = 0; i < n_; ++i) {
    const double ratio = div_ru(times(i), v[i]);
    if (!(ratio < 1)) return {-kInfinity, kInfinity};
    factor *= Interval(sub_rd(1, ratio), add_ru(1, ratio));
  }
  const Interval of_inverse = determinant_of(inverse_, n_);
  if (contains_zero(of_inverse)) return {-kInfinity, kInfinity};
  return factor / of_inverse;
}

}  // namespace regulus::detail
