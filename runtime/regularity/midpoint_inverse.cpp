// SPDX-License-Identifier: Apache-2.0
// Gauss–Jordan in place with row pivoting. Arithmetic runs over all lanes at once; only the choice
// of the pivot row differs from lane to lane, so rows are exchanged lane by lane.
#include "regulus/regularity/midpoint_inverse.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace regulus {
namespace {

struct Elimination {
  double* a;
  std::size_t n;
  double* determinant;
  std::size_t pivot_row[kMaxColumns][kLanes];

  double* entry(std::size_t i, std::size_t j) noexcept { return a + (i * n + j) * kLanes; }

  void exchange_rows(std::size_t i, std::size_t k, std::size_t lane) noexcept {
    for (std::size_t j = 0; j < n; ++j) std::swap(entry(i, j)[lane], entry(k, j)[lane]);
  }
  void exchange_columns(std::size_t j, std::size_t k, std::size_t lane) noexcept {
    for (std::size_t i = 0; i < n; ++i) std::swap(entry(i, j)[lane], entry(i, k)[lane]);
  }

  void choose_pivots(std::size_t k) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      std::size_t best = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::fabs(entry(i, k)[lane]) > std::fabs(entry(best, k)[lane])) best = i;
      pivot_row[k][lane] = best;
      if (best == k) continue;
      exchange_rows(best, k, lane);
      determinant[lane] = -determinant[lane];
    }
  }

  void divide_row(std::size_t k) noexcept {
    double reciprocal[kLanes];
    double* pivot = entry(k, k);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      determinant[lane] *= pivot[lane];
      reciprocal[lane] = 1.0 / pivot[lane];
      pivot[lane] = 1.0;
    }
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) entry(k, j)[lane] *= reciprocal[lane];
  }

  void clear_column(std::size_t k, std::size_t i) noexcept {
    double factor[kLanes];
    std::memcpy(factor, entry(i, k), sizeof factor);
    std::memset(entry(i, k), 0, sizeof factor);
    for (std::size_t j = 0; j < n; ++j) {
      double* target = entry(i, j);
      const double* source = entry(k, j);
      for (std::size_t lane = 0; lane < kLanes; ++lane) target[lane] -= factor[lane] * source[lane];
    }
  }

  void run() noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) determinant[lane] = 1.0;
    for (std::size_t k = 0; k < n; ++k) {
      choose_pivots(k);
      divide_row(k);
      for (std::size_t i = 0; i < n; ++i)
        if (i != k) clear_column(k, i);
    }
    for (std::size_t k = n; k-- > 0;)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        if (pivot_row[k][lane] != k) exchange_columns(pivot_row[k][lane], k, lane);
  }
};

LaneMask lanes_not_finite(const double* x, std::size_t entries) noexcept {
  double sum[kLanes] = {};
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += x[point_at(e, lane)] * 0.0;
  LaneMask mask = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (!(sum[lane] == 0.0)) mask |= 1U << lane;
  return mask;
}

void invert_square(double* a, std::size_t n, double* determinant) noexcept {
  Elimination elimination{a, n, determinant, {}};
  elimination.run();
}

/// Columns may carry different units (cm, cm²): brought to length one first, or AᵀA would square
/// their ratio into its condition number.
void scale_columns(const double* a, std::size_t m, std::size_t n, double* scaled,
                   double* scale) noexcept {
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      double squares = 0;
      for (std::size_t i = 0; i < m; ++i) {
        const double x = a[point_at(i * n + j, lane)];
        squares += x * x;
      }
      scale[point_at(j, lane)] = 1.0 / std::sqrt(squares);
      for (std::size_t i = 0; i < m; ++i)
        scaled[point_at(i * n + j, lane)] = a[point_at(i * n + j, lane)] * scale[point_at(j, lane)];
    }
}

void multiply_transpose(const double* a, std::size_t m, std::size_t n, double* gram) noexcept {
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        double sum = 0;
        for (std::size_t i = 0; i < m; ++i)
          sum += a[point_at(i * n + j, lane)] * a[point_at(i * n + k, lane)];
        gram[point_at(j * n + k, lane)] = sum;
      }
}

void left_inverse(const double* a, std::size_t m, std::size_t n, double* inverse,
                  double* determinant) noexcept {
  alignas(64) double scaled[kMaxRows * kMaxColumns * kLanes];
  alignas(64) double scale[kMaxColumns * kLanes];
  alignas(64) double gram[kMaxColumns * kMaxColumns * kLanes];
  scale_columns(a, m, n, scaled, scale);
  multiply_transpose(scaled, m, n, gram);
  invert_square(gram, n, determinant);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k)
          sum += gram[point_at(j * n + k, lane)] * scaled[point_at(i * n + k, lane)];
        inverse[point_at(j * m + i, lane)] = sum * scale[point_at(j, lane)];
      }
}

}  // namespace

LaneMask approx_inverse(const double* matrix, std::size_t m, std::size_t n, double* inverse,
                        double* approx_determinant) noexcept {
  if (m == n) {
    std::memcpy(inverse, matrix, n * n * kLanes * sizeof(double));
    invert_square(inverse, n, approx_determinant);
  } else {
    left_inverse(matrix, m, n, inverse, approx_determinant);
  }
  return lanes_not_finite(inverse, n * m);
}

}  // namespace regulus
