// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/linear_algebra.hpp"

#include <arb_mat.h>

#include <cmath>
#include <utility>

namespace regulus::verifier {
namespace {

/// Gauss–Jordan elimination of [A | I], in place: A becomes I, `inverse` its inverse.
bool invert(std::vector<double>& A, std::size_t n, std::vector<double>& inverse) {
  inverse.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1.0;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (std::fabs(A[i * n + c]) > std::fabs(A[pivot * n + c])) pivot = i;
    const double p = A[pivot * n + c];
    if (!(std::fabs(p) > 0.0)) return false;
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(A[c * n + j], A[pivot * n + j]);
      std::swap(inverse[c * n + j], inverse[pivot * n + j]);
      A[c * n + j] /= p;
      inverse[c * n + j] /= p;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = A[i * n + c];
      if (i == c || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        A[i * n + j] -= factor * A[c * n + j];
        inverse[i * n + j] -= factor * inverse[c * n + j];
      }
    }
  }
  return true;
}

}  // namespace

bool approx_left_inverse(const std::vector<double>& A, std::size_t rows, std::size_t columns,
                         Matrix& K) {
  // (AᵀA)⁻¹Aᵀ, or A⁻¹, which has the better condition
  const bool is_square = rows == columns;
  std::vector<double> square(columns * columns), inverse;
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t r = 0; !is_square && r < rows; ++r)
        square[i * columns + j] += A[r * columns + i] * A[r * columns + j];
  if (is_square) square = A;
  if (!invert(square, columns, inverse)) return false;
  K.assign(columns * rows, 0.0);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < columns; ++i) {
      if (is_square) K[r * columns + i] = inverse[i * columns + r];
      for (std::size_t j = 0; !is_square && j < columns; ++j)
        K[r * columns + i] += inverse[i * columns + j] * A[r * columns + j];
    }
  return true;
}

Ball determinant(const std::vector<Ball>& A, std::size_t order, long bits) {
  arb_mat_t matrix;
  arb_mat_init(matrix, slong(order), slong(order));
  for (std::size_t e = 0; e < A.size(); ++e)
    arb_set(arb_mat_entry(matrix, e / order, e % order), A[e].get());
  Ball result;
  arb_mat_det(result.get(), matrix, bits);
  arb_mat_clear(matrix);
  return result;
}

Ball determinant(const std::vector<double>& A, std::size_t order, long bits) {
  std::vector<Ball> balls;
  for (const double x : A) balls.emplace_back(point(x), bits);
  return determinant(balls, order, bits);
}

}  // namespace regulus::verifier
