// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/determinant.hpp"

#include <algorithm>
#include <utility>

#include "runtime/regularity/upward_elimination.hpp"

namespace regulus::detail {
namespace {

using Indices = std::array<unsigned char, kMaxColumns>;

/// The remaining rows and columns of M.
struct Minor {
  std::size_t order;
  Indices rows;
  Indices columns;
};

void erase(Indices& indices, std::size_t position, std::size_t count) noexcept {
  for (std::size_t k = position; k + 1 < count; ++k) indices[k] = indices[k + 1];
}

Minor without(const Minor& minor, std::size_t row, std::size_t column) noexcept {
  Minor result = minor;
  erase(result.rows, row, minor.order);
  erase(result.columns, column, minor.order);
  --result.order;
  return result;
}

struct Line {
  bool is_row;
  std::size_t index;
};

/// Returns the line of least total width; all have equally many entries. A choice, not a bound.
Line format_narrowest(const LaneMatrix& M, const Minor& minor) noexcept {
  double row_width[kMaxColumns] = {};
  double column_width[kMaxColumns] = {};
  for (std::size_t i = 0; i < minor.order; ++i)
    for (std::size_t j = 0; j < minor.order; ++j) {
      const Interval& x = M.at(minor.rows[i], minor.columns[j]);
      row_width[i] += x.hi - x.lo;
      column_width[j] += x.hi - x.lo;
    }
  const auto row = std::min_element(row_width, row_width + minor.order) - row_width;
  const auto column = std::min_element(column_width, column_width + minor.order) - column_width;
  const bool is_row = row_width[row] <= column_width[column];
  return {is_row, static_cast<std::size_t>(is_row ? row : column)};
}

bool is_zero(const Interval& x) noexcept { return x.lo == 0.0 && x.hi == 0.0; }

Interval expand(const LaneMatrix& M, const Minor& minor) noexcept {
  const auto at = [&](std::size_t i, std::size_t j) -> const Interval& {
    return M.at(minor.rows[i], minor.columns[j]);
  };
  if (minor.order == 1) return at(0, 0);
  if (minor.order == 2) return at(0, 0) * at(1, 1) - at(0, 1) * at(1, 0);
  const Line line = format_narrowest(M, minor);
  Interval sum(0.0);
  for (std::size_t k = 0; k < minor.order; ++k) {
    const std::size_t i = line.is_row ? line.index : k;
    const std::size_t j = line.is_row ? k : line.index;
    // 0 times a bounded minor is 0. The test is useful: full Jacobians of simple robots are sparse.
    if (is_zero(at(i, j))) continue;
    const Interval term = at(i, j) * expand(M, without(minor, i, j));
    sum = (i + j) % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

Minor trailing(std::size_t n, std::size_t first) noexcept {
  Minor minor{n - first, {}, {}};
  for (std::size_t k = first; k < n; ++k)
    minor.rows[k - first] = minor.columns[k - first] = static_cast<unsigned char>(k);
  return minor;
}

std::size_t pivot_row(const LaneMatrix& M, std::size_t k) noexcept {
  std::size_t best = k;
  for (std::size_t i = k + 1; i < M.n; ++i)
    if (mig(M.at(i, k)) > mig(M.at(best, k))) best = i;
  return best;
}

void eliminate(LaneMatrix& M, std::size_t k) noexcept {
  for (std::size_t i = k + 1; i < M.n; ++i) {
    if (is_zero(M.at(i, k))) continue;
    const Interval factor = M.at(i, k) / M.at(k, k);
    for (std::size_t j = k + 1; j < M.n; ++j) M.at(i, j) = M.at(i, j) - factor * M.at(k, j);
  }
}

}  // namespace

LaneMatrix matrix_of_lane(ConstIntervalMatrix x, std::size_t lane) noexcept {
  LaneMatrix M;
  M.n = x.rows();
  for (std::size_t e = 0; e < x.size(); ++e)
    M.entries[e] = Interval(x.lower(e, lane), x.upper(e, lane));
  return M;
}

LaneMatrix matrix_of_lane(ConstPointMatrix x, std::size_t lane) noexcept {
  LaneMatrix M;
  M.n = x.rows();
  for (std::size_t e = 0; e < x.size(); ++e) M.entries[e] = Interval(x.at(e, lane));
  return M;
}

Interval enclose_determinant(const LaneMatrix& M) noexcept {
  if (M.n > kMaxExpansion) return enclose_determinant_by_elimination(M);
  return expand(M, trailing(M.n, 0));
}

Interval enclose_determinant_by_elimination(const LaneMatrix& M) noexcept {
  if (const auto determinant = enclose_determinant_upward(M)) return *determinant;
  LaneMatrix work = M;
  Interval product(1.0);
  for (std::size_t k = 0; k < M.n; ++k) {
    const std::size_t row = pivot_row(work, k);
    if (mig(work.at(row, k)) == 0.0) {
      if (M.n - k > kMaxExpansion) return kEntire;
      return product * expand(work, trailing(M.n, k));
    }
    if (row != k) {
      for (std::size_t j = 0; j < M.n; ++j) std::swap(work.at(row, j), work.at(k, j));
      product = -product;
    }
    product = product * work.at(k, k);
    eliminate(work, k);
  }
  return product;
}

}  // namespace regulus::detail
