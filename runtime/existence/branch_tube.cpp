// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/branch_tube.hpp"

#include <algorithm>
#include <cmath>

namespace regulus {

std::vector<Interval> enclose(const BranchTube& tube, std::span<const Interval> box) {
  const std::size_t n = tube.center.size(), m = tube.at.size();
  std::vector<Interval> unknowns(n);
  for (std::size_t i = 0; i < n; ++i) {
    unknowns[i] = Interval(tube.center[i]) + Interval(-tube.radius[i], tube.radius[i]);
    for (std::size_t k = 0; k < m; ++k)
      unknowns[i] += Interval(tube.slopes[i * m + k]) * (box[k] - Interval(tube.at[k]));
  }
  return unknowns;
}

TubeImage image_of(const BranchTube& tube, std::span<const Interval> box,
                   std::span<const double> inverse, const TubeSystem& system) {
  const std::size_t n = tube.center.size(), m = tube.at.size();
  TubeImage image;
  image.radius.assign(n, 0), image.offset.assign(n, 0);
  image.impact.assign(n * m, 0), image.spread.assign(n * n, 0);
  // Row j of Φ_x + Φ_p S.
  std::vector<Interval> along(n * m);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < m; ++k) {
      Interval sum = system.by_variable[j * m + k];
      for (std::size_t l = 0; l < n; ++l)
        sum += system.by_unknown[j * n + l] * Interval(tube.slopes[l * m + k]);
      along[j * m + k] = sum;
    }
  for (std::size_t i = 0; i < n; ++i) {
    const auto combined = [&](std::span<const Interval> columns, std::size_t count, std::size_t at,
                              Interval sum) {
      for (std::size_t j = 0; j < n; ++j)
        sum += Interval(inverse[i * n + j]) * columns[j * count + at];
      return mag(sum);
    };
    image.offset[i] = combined(system.value, 1, 0, 0.0);
    double sum = image.offset[i];
    for (std::size_t k = 0; k < m; ++k) {
      const double reach = mag(box[k] - Interval(tube.at[k]));
      image.impact[i * m + k] = reach == 0 ? 0 : mul_ru(combined(along, m, k, 0.0), reach);
      sum = add_ru(sum, image.impact[i * m + k]);
    }
    for (std::size_t l = 0; l < n; ++l) {
      image.spread[i * n + l] = combined(system.by_unknown, n, l, i == l ? -1.0 : 0.0);
      sum = add_ru(sum, mul_ru(image.spread[i * n + l], tube.radius[l]));
    }
    image.radius[i] = sum;
  }
  return image;
}

/// A bound that is not a number fails every comparison.
bool has_one_solution(const BranchTube& tube, const TubeImage& image) {
  for (std::size_t i = 0; i < tube.radius.size(); ++i)
    if (!(image.radius[i] < tube.radius[i]) || !(tube.radius[i] < kInfinity)) return false;
  return !tube.radius.empty();
}

std::optional<std::vector<double>> approx_inverse_of(std::span<const double> matrix,
                                                     std::size_t n) {
  std::vector<double> a(matrix.begin(), matrix.end()), inverse(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (std::abs(a[i * n + c]) > std::abs(a[pivot * n + c])) pivot = i;
    if (!(std::abs(a[pivot * n + c]) > 0)) return std::nullopt;
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a[c * n + j], a[pivot * n + j]);
      std::swap(inverse[c * n + j], inverse[pivot * n + j]);
    }
    const double divisor = a[c * n + c];
    for (std::size_t j = 0; j < n; ++j) a[c * n + j] /= divisor, inverse[c * n + j] /= divisor;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + c];
      if (i == c || factor == 0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[c * n + j];
        inverse[i * n + j] -= factor * inverse[c * n + j];
      }
    }
  }
  if (!std::ranges::all_of(inverse, [](double x) { return std::isfinite(x); })) return std::nullopt;
  return inverse;
}

}  // namespace regulus
