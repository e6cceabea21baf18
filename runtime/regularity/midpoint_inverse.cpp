// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/midpoint_inverse.hpp"

#include <cmath>
#include <cstring>

#include "runtime/regularity/backend.hpp"

namespace regulus::detail {
namespace {

/// Columns may have different units (cm, cm²). They are scaled to length one first; otherwise AᵀA
/// would square their ratio in its condition number.
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
                  LaneNumbers& determinant) noexcept {
  alignas(64) double scaled[kMaxRows * kMaxColumns * kLanes];
  alignas(64) double scale[kMaxColumns * kLanes];
  alignas(64) double gram[kMaxColumns * kMaxColumns * kLanes];
  scale_columns(a, m, n, scaled, scale);
  multiply_transpose(scaled, m, n, gram);
  regularity_backend().invert(PointMatrix(gram, n, n), determinant);
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

LaneMask approx_inverse(ConstPointMatrix matrix, PointMatrix inverse,
                        LaneNumbers& approx_determinant) noexcept {
  const std::size_t m = matrix.rows(), n = matrix.columns();
  if (m == n) {
    std::memcpy(inverse.data(), matrix.data(), n * n * kLanes * sizeof(double));
    regularity_backend().invert(inverse, approx_determinant);
  } else {
    left_inverse(matrix.data(), m, n, inverse.data(), approx_determinant);
  }
  return regularity_backend().round_rows_to_grid(inverse);
}

}  // namespace regulus::detail
