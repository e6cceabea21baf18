// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/midpoint_inverse.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "runtime/regularity/backend.hpp"

namespace regulus {
namespace {

constexpr double kLeastRow = 0x1p-800;

/// Adding and subtracting 1.5·2^52 times the grid leaves the nearest multiple of the grid, or the
/// next one in another rounding mode. With 2^L the power of two below the greatest entry, the grid
/// is 2^(L−27). Returns the lanes in which the row is too small for a grid.
LaneMask round_to_grid(double* row, std::size_t length) noexcept {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  double greatest[kLanes] = {}, anchor[kLanes];
  for (std::size_t i = 0; i < length; ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double size = std::fabs(row[point_at(i, lane)]);
      greatest[lane] = size > greatest[lane] ? size : greatest[lane];
    }
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    anchor[lane] =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(greatest[lane]) & kExponent) * 0x1.8p25;
  for (std::size_t i = 0; i < length; ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      double& entry = row[point_at(i, lane)];
      entry = (entry + anchor[lane]) - anchor[lane];
    }
  LaneMask without = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (greatest[lane] != 0.0 && !(greatest[lane] >= kLeastRow)) without |= 1U << lane;
  return without;
}

/// Returns the lanes in which some row is too small for a grid.
LaneMask round_rows_to_grid(double* inverse, std::size_t rows, std::size_t length) noexcept {
  LaneMask without = 0;
  for (std::size_t i = 0; i < rows; ++i)
    without |= round_to_grid(inverse + point_at(i * length, 0), length);
  return without;
}

LaneMask lanes_not_finite(const double* x, std::size_t entries) noexcept {
  double sum[kLanes] = {};
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += x[point_at(e, lane)] * 0.0;
  LaneMask mask = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (!(sum[lane] == 0.0)) mask |= 1U << lane;
  return mask;
}

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
  const LaneMask without_grid = round_rows_to_grid(inverse.data(), n, m);
  return without_grid | lanes_not_finite(inverse.data(), n * m);
}

}  // namespace regulus
