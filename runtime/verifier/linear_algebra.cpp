// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/linear_algebra.hpp"

#include <arb_mat.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfPivot = 64;

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

double length(const std::vector<double>& x) {
  double largest = 0.0, sum = 0.0;
  for (const double value : x) largest = std::max(largest, std::fabs(value));
  if (!(largest > 0.0)) return 0.0;
  for (const double value : x) sum += (value / largest) * (value / largest);
  return largest * std::sqrt(sum);
}

/// A = QR by Gram and Schmidt, twice for each column: after one pass it may not be orthogonal.
bool orthogonalise(std::vector<std::vector<double>>& Q, std::vector<double>& R) {
  const std::size_t n = Q.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < 2 * j; ++k) {
      const std::vector<double>& q = Q[k % j];
      const double part = std::inner_product(q.begin(), q.end(), Q[j].begin(), 0.0);
      for (std::size_t row = 0; row < q.size(); ++row) Q[j][row] -= part * q[row];
      R[k % j * n + j] += part;
    }
    R[j * n + j] = length(Q[j]);
    if (!(R[j * n + j] > 0.0)) return false;
    for (double& x : Q[j]) x /= R[j * n + j];
  }
  return true;
}

/// Uses K = R⁻¹Qᵀ: its condition is that of A. The condition of (AᵀA)⁻¹Aᵀ is the square of it.
bool invert_tall(const std::vector<double>& A, std::size_t rows, std::size_t n, Matrix& K) {
  std::vector<std::vector<double>> Q(n, std::vector<double>(rows));
  std::vector<double> R(n * n);
  for (std::size_t e = 0; e < A.size(); ++e) Q[e % n][e / n] = A[e];
  if (!orthogonalise(Q, R)) return false;
  K.assign(n * rows, 0.0);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = n; i-- > 0;) {
      double sum = Q[i][row];
      for (std::size_t j = i + 1; j < n; ++j) sum -= R[i * n + j] * K[row * n + j];
      K[row * n + i] = sum / R[i * n + i];
    }
  return true;
}

/// Returns the element with the greatest certain magnitude, outside of the used rows and columns;
/// nullopt if each of them may be 0.
std::optional<std::size_t> pivot_of(const std::vector<Ball>& A, std::size_t columns,
                                    const std::vector<bool>& used_row,
                                    const std::vector<bool>& used_column) {
  std::optional<std::size_t> best;
  arf_t most, least;
  arf_init(most), arf_init(least);
  for (std::size_t e = 0; e < A.size(); ++e) {
    if (used_row[e / columns] || used_column[e % columns] || !arb_is_finite(A[e].get())) continue;
    arb_get_abs_lbound_arf(least, A[e].get(), kBitsOfPivot);
    if (arf_cmp(least, most) > 0) best = e, arf_set(most, least);
  }
  arf_clear(most), arf_clear(least);
  return best;
}

}  // namespace

bool approx_left_inverse(const std::vector<double>& A, std::size_t rows, std::size_t columns,
                         Matrix& K) {
  if (rows != columns) return invert_tall(A, rows, columns, K);
  std::vector<double> square = A, inverse;
  if (!invert(square, columns, inverse)) return false;
  K.resize(columns * columns);
  for (std::size_t e = 0; e < K.size(); ++e) K[e % columns * columns + e / columns] = inverse[e];
  return true;
}

/// Gaussian elimination: for every member of A, each step keeps its rank.
std::vector<std::size_t> independent_rows(std::vector<Ball> A, std::size_t rows,
                                          std::size_t columns, long bits) {
  std::vector<bool> used_row(rows), used_column(columns);
  std::vector<std::size_t> result;
  Ball factor;
  while (const auto pivot = pivot_of(A, columns, used_row, used_column)) {
    const std::size_t row = *pivot / columns, column = *pivot % columns;
    used_row[row] = used_column[column] = true;
    result.push_back(row);
    for (std::size_t r = 0; r < rows; ++r) {
      if (used_row[r]) continue;
      arb_div(factor.get(), A[r * columns + column].get(), A[*pivot].get(), bits);
      for (std::size_t c = 0; c < columns; ++c)
        if (!used_column[c])
          arb_submul(A[r * columns + c].get(), factor.get(), A[row * columns + c].get(), bits);
    }
  }
  return result;
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

/// With G = XᵀX of order c and of mean eigenvalue m, the square of the norm is at most m + (((c −
/// 1)/c)(‖G‖² − c·m²))^½, the norm being Frobenius's. Entries of G err by less than 2⁻⁴⁹ tr G.
double spectral_norm(const std::vector<double>& X, std::size_t rows, std::size_t c) {
  double trace = 0.0, squares = 0.0;
  for (std::size_t a = 0; a < c; ++a)
    for (std::size_t b = 0; b < c; ++b) {
      double entry = 0.0;
      for (std::size_t row = 0; row < rows; ++row) entry += X[row * c + a] * X[row * c + b];
      if (a == b) trace += entry;
      squares += entry * entry;
    }
  const double order = double(c), mean = trace / order;
  const double spread = std::max(squares - trace * mean, 0.0) + kRounding * trace * trace;
  return inflate(std::sqrt(inflate(mean + std::sqrt(inflate((order - 1) / order * spread)))));
}

}  // namespace regulus::verifier
