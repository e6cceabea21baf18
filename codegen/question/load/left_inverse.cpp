// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/left_inverse.hpp"

#include <cmath>

namespace regulus::detail {
namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Makes a vector orthogonal to all of `basis` and of length 1. Appends the coefficients of the
/// basis to `coefficients`. Returns its length before, 0 if hardly anything is left.
///
/// Twice is enough (Kahan and Parlett).
double orthonormalise(Vector& v, const std::vector<Vector>& basis, Vector& coefficients) {
  const double before = std::sqrt(dot(v, v));
  coefficients.assign(basis.size(), 0);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t j = 0; j < basis.size(); ++j) {
      const double along = dot(basis[j], v);
      coefficients[j] += along;
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= along * basis[j][i];
    }
  const double length = std::sqrt(dot(v, v));
  if (!(length > 1e-13 * before)) return 0;
  for (double& x : v) x /= length;
  return length;
}

/// Appends vectors to an orthonormal basis until it spans everything.
void complete(std::vector<Vector>& basis, std::size_t rows) {
  Vector ignored;
  while (basis.size() < rows) {
    Vector best;
    double most = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      Vector unit(rows, 0.0);
      unit[i] = 1;
      const double length = orthonormalise(unit, basis, ignored);
      if (length > most) most = length, best = unit;
    }
    basis.push_back(std::move(best));
  }
}

}  // namespace

std::optional<LeftInverse> approx_left_inverse(std::span<const double> A, std::size_t rows,
                                               std::size_t columns) {
  std::vector<Vector> q, r;  // A = Q·R; r[j]: column j of R
  for (std::size_t j = 0; j < columns; ++j) {
    Vector column(rows), coefficients;
    for (std::size_t i = 0; i < rows; ++i) column[i] = A[i * columns + j];
    const double length = orthonormalise(column, q, coefficients);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    coefficients.push_back(length);
    q.push_back(std::move(column));
    r.push_back(std::move(coefficients));
  }
  LeftInverse result{Vector(columns * rows), {}};
  for (std::size_t j = columns; j-- > 0;)
    for (std::size_t i = 0; i < rows; ++i) {
      double sum = q[j][i];
      for (std::size_t l = j + 1; l < columns; ++l) sum -= r[l][j] * result.inverse[l * rows + i];
      result.inverse[j * rows + i] = sum / r[j][j];
    }
  complete(q, rows);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = columns; j < rows; ++j) result.null_space.push_back(q[j][i]);
  return result;
}

}  // namespace regulus::detail
