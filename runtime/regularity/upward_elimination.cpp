// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/upward_elimination.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/lanes.hpp"

namespace regulus::detail {
namespace {

/// The interval [−n, h] as (n, h). Every operation rounds both upward, in this mode of the processor.
using Bounds __attribute__((vector_size(16))) = double;

REGULUS_LANE_INLINE Bounds opposite(Bounds x) noexcept { return Bounds{x[1], x[0]}; }
REGULUS_LANE_INLINE Bounds difference(Bounds x, Bounds y) noexcept { return x + opposite(y); }
REGULUS_LANE_INLINE Bounds larger(Bounds x, Bounds y) noexcept { return x > y ? x : y; }

/// The largest of all four products of ends, as signs cannot be predicted. −(−n·y) is n·y exactly.
REGULUS_LANE_INLINE Bounds product(Bounds x, Bounds y) noexcept {
  const Bounds n{x[0], x[0]}, h{x[1], x[1]};
  const Bounds of_lower{-y[0], y[0]}, of_upper{y[1], -y[1]};
  return larger(larger(n * of_lower, n * of_upper), larger(h * -of_lower, h * -of_upper));
}

/// Requires  y without 0.
Bounds quotient(Bounds x, Bounds y) noexcept {
  if (y[1] < 0.0) return quotient(opposite(x), opposite(y));
  if (x[0] > 0.0 && x[1] <= 0.0) return opposite(quotient(opposite(x), y));
  return Bounds{x[0] / (x[0] <= 0.0 ? y[1] : -y[0]), x[1] / -y[0]};
}

/// Returns the least magnitude.
double least(Bounds x) noexcept { return std::max({-x[0], -x[1], 0.0}); }

class Elimination {
 public:
  explicit Elimination(const LaneMatrix& M) noexcept : n_(M.n) {
    for (std::size_t i = 0; i < n_; ++i) {
      row_[i] = entries_ + i * n_;
      for (std::size_t j = 0; j < n_; ++j) set(row_[i][j], Bounds{-M.at(i, j).lo, M.at(i, j).hi});
    }
  }

  /// In the mode upward. Returns false if there is no result.
  [[nodiscard]] bool run(Bounds& determinant) noexcept {
    determinant = Bounds{-1.0, 1.0};
    for (std::size_t k = 0; k < n_; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n_; ++i)
        if (least(row_[i][k]) > least(row_[pivot][k])) pivot = i;
      if (k + 1 < n_ && !(least(row_[pivot][k]) > 0.0)) return false;  // the last one may contain 0
      if (pivot != k) {
        std::swap(row_[pivot], row_[k]);
        determinant = opposite(determinant);
      }
      determinant = product(determinant, row_[k][k]);
      for (std::size_t i = k + 1; i < n_; ++i) eliminate(k, i);
    }
    set(determinant, determinant);
    return width_[0] + width_[1] < HUGE_VAL;
  }

 private:
  void eliminate(std::size_t k, std::size_t i) noexcept {
    if (row_[i][k][0] == 0.0 && row_[i][k][1] == 0.0) return;
    Bounds factor;
    set(factor, quotient(row_[i][k], row_[k][k]));
    for (std::size_t j = k + 1; j < n_; ++j)
      set(row_[i][j], difference(row_[i][j], product(factor, row_[k][j])));
  }

  void set(Bounds& entry, Bounds x) noexcept {
    entry = x;
    width_ += x + opposite(x);
  }

  const std::size_t n_;
  Bounds width_ = {0.0, 0.0};  ///< of all entries: infinite or NaN if one of them was not bounded
  Bounds entries_[kMaxColumns * kMaxColumns];
  Bounds* row_[kMaxColumns];
};

[[gnu::noinline]] bool run_upward(const LaneMatrix& M, Interval& determinant) noexcept {
  Elimination elimination(M);
  Bounds bounds;
  if (!elimination.run(bounds)) return false;
  determinant = Interval(-bounds[0], bounds[1]);
  return true;
}

}  // namespace

std::optional<Interval> enclose_determinant_upward(const LaneMatrix& M) noexcept {
  const FloatingPointScope scope(FloatingPointRounding::kUpward);
  Interval determinant(0.0);
  if (!run_upward(M, determinant)) return std::nullopt;
  return determinant;
}

}  // namespace regulus::detail
