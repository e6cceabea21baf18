// SPDX-License-Identifier: GPL-3.0-or-later
// Random robots of which some rows have no limits, those of passive constraints, and the forces that hold
// a load at one pose: an oracle in plain doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// A(x) = A₀ + Σ x_k B_k, with |x_k| ≤ radius; the last rows are free, and the first have |f_i| ≤ 1.
struct RobotWithFreeRows {
  using Doubles = std::vector<double>;
  static constexpr std::size_t kColumns = 6, kParameters = 2;

  std::size_t rows, free;
  double radius;
  std::vector<Doubles> parts;  ///< A₀, B₁, B₂: row-major, multiples of 1/64

  RobotWithFreeRows(RandomSource& random, std::size_t all, std::size_t without_limits)
      : rows(all), free(without_limits), radius(std::ldexp(1.0, -int(random.below(9)) - 2)) {
    for (std::size_t part = 0; part <= kParameters; ++part) {
      parts.emplace_back();
      for (std::size_t e = 0; e < rows * kColumns; ++e)
        parts.back().push_back(std::round(random.between(-64, 64)) / 64);
    }
  }

  [[nodiscard]] bool is_free(std::size_t row) const { return row >= rows - free; }
  [[nodiscard]] Doubles at(const Doubles& x) const {
    Doubles A = parts[0];
    for (std::size_t k = 0; k < kParameters; ++k)
      for (std::size_t e = 0; e < A.size(); ++e) A[e] += x[k] * parts[k + 1][e];
    return A;
  }
  [[nodiscard]] Doubles pose(RandomSource& random) const {
    Doubles x;
    for (std::size_t k = 0; k < kParameters; ++k) x.push_back(random.between(-radius, radius));
    return x;
  }

  /// Returns the wrench at a random pose of random forces: those with limits are at most `most`, the others
  /// may be large.
  [[nodiscard]] Doubles held_wrench(RandomSource& random, double most) const {
    Doubles f;
    const double size = std::ldexp(1.0, int(random.below(14)) - 2);
    for (std::size_t i = 0; i < rows; ++i)
      f.push_back(is_free(i) ? random.between(-size, size) : random.between(-most, most));
    const Doubles A = at(pose(random));
    Doubles w(kColumns, 0.0);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < kColumns; ++j) w[j] += A[i * kColumns + j] * f[i];
    return w;
  }

  /// Returns the largest force with limits of the only ones that hold a wrench at a pose; 0 where A is
  /// nearly singular.
  ///
  /// Requires  as many rows as columns.
  [[nodiscard]] double largest_force(const Doubles& x, Doubles f) const {
    const Doubles A = at(x);
    std::vector<Doubles> equations(kColumns, Doubles(kColumns));
    for (std::size_t i = 0; i < kColumns; ++i)
      for (std::size_t j = 0; j < kColumns; ++j) equations[j][i] = A[i * kColumns + j];
    for (std::size_t k = 0; k < kColumns; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k; i < kColumns; ++i)
        if (std::fabs(equations[i][k]) > std::fabs(equations[pivot][k])) pivot = i;
      std::swap(equations[k], equations[pivot]), std::swap(f[k], f[pivot]);
      if (std::fabs(equations[k][k]) < 1e-3) return 0;
      for (std::size_t i = 0; i < kColumns; ++i) {
        if (i == k) continue;
        const double factor = equations[i][k] / equations[k][k];
        for (std::size_t j = k; j < kColumns; ++j) equations[i][j] -= factor * equations[k][j];
        f[i] -= factor * f[k];
      }
    }
    double largest = 0;
    for (std::size_t k = 0; k < kColumns; ++k)
      if (!is_free(k)) largest = std::max(largest, std::fabs(f[k] / equations[k][k]));
    return largest;
  }
};

}  // namespace regulus::detail::test
