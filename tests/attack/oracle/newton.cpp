// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/newton.hpp"

#include <cmath>

namespace regulus::detail::attack {
namespace {

constexpr int kSteps = 80;
constexpr double kStep = 1e-6;     ///< of a difference quotient
constexpr double kIsRoot = 1e-11;  ///< of the largest residual
constexpr double kHasRank = 1e-7;  ///< the least pivot of JᵀJ, as a part of the largest

double largest_part(const Numbers& r) {
  double most = 0;
  for (const double x : r) most = std::fmax(most, std::fabs(x));
  return most;
}

double sum_of_squares(const Numbers& r) {
  double sum = 0;
  for (const double x : r) sum += x * x;
  return sum;
}

std::vector<Numbers> derivatives(const Residual& residual, const Numbers& x) {
  std::vector<Numbers> columns;
  for (std::size_t j = 0; j < x.size(); ++j) {
    Numbers before = x, after = x;
    before[j] -= kStep, after[j] += kStep;
    Numbers column = residual(after);
    const Numbers low = residual(before);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = (column[i] - low[i]) / (2 * kStep);
    columns.push_back(std::move(column));
  }
  return columns;
}

/// Solves (JᵀJ + damping)·d = −Jᵀr by elimination with diagonal pivots.
std::optional<Numbers> newton_step(const std::vector<Numbers>& columns, const Numbers& r,
                                   double damping, double least_pivot) {
  const std::size_t n = columns.size();
  std::vector<Numbers> A(n, Numbers(n + 1, 0));
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < r.size(); ++k) {
      A[i][n] -= columns[i][k] * r[k];
      for (std::size_t j = 0; j < n; ++j) A[i][j] += columns[i][k] * columns[j][k];
    }
    most = std::fmax(most, A[i][i]);
  }
  for (std::size_t i = 0; i < n; ++i) A[i][i] += damping * most;
  std::vector<bool> is_done(n, false);
  std::vector<std::size_t> order;
  for (std::size_t round = 0; round < n; ++round) {
    std::size_t p = n;
    for (std::size_t i = 0; i < n; ++i)
      if (!is_done[i] && (p == n || A[i][i] > A[p][p])) p = i;
    if (!(A[p][p] > least_pivot * most)) return std::nullopt;
    is_done[p] = true;
    order.push_back(p);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == p) continue;
      const double factor = A[i][p] / A[p][p];
      for (std::size_t j = 0; j <= n; ++j) A[i][j] -= factor * A[p][j];
    }
  }
  Numbers d(n);
  for (std::size_t i = 0; i < n; ++i) d[i] = A[i][n] / A[i][i];
  return d;
}

}  // namespace

std::optional<Numbers> newton_root(const Residual& residual, Numbers x) {
  double damping = 1e-2;
  Numbers r = residual(x);
  for (int i = 0; i < kSteps && largest_part(r) > kIsRoot; ++i) {
    const auto d = newton_step(derivatives(residual, x), r, damping, 0);
    if (!d) return std::nullopt;
    Numbers next = x;
    for (std::size_t j = 0; j < x.size(); ++j) next[j] += (*d)[j];
    Numbers there = residual(next);
    if (sum_of_squares(there) < sum_of_squares(r)) {
      x = std::move(next), r = std::move(there), damping *= 0.1;
      if (damping < 1e-12) damping = 0;
    } else {
      damping = damping == 0 ? 1e-10 : damping * 10;
      if (damping > 1e8) return std::nullopt;
    }
  }
  if (!(largest_part(r) <= kIsRoot) || !newton_step(derivatives(residual, x), r, 0, kHasRank))
    return std::nullopt;
  return x;
}

}  // namespace regulus::detail::attack
