// SPDX-License-Identifier: Apache-2.0
// The search for y ≠ 0 with y_s = −Σ_k δ_k(b_k + c_k)·y − Σ_jk δ_jδ_k(b_jk + c_jk)·y: branch and
// prune over directions. If b dominates, this comes close to the critical spread of the quantities:
// the δ_k of one row are independent of those of the others, so the bounds are attained for a single
// y.
#include <algorithm>

#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/touched_rows.hpp"

namespace regulus::verifier {
namespace {

/// Most boxes of directions for one box. A single pose cannot be split: it is worth more.
constexpr std::size_t kMostDirections = 4000, kMostDirectionsOfAPose = 100'000;
constexpr double kNarrowestRadius = 0x1p-20;  ///< relative to v
constexpr double kOutward = 1 + 0x1p-20;      ///< covers roundings of middles: radii are no smaller

}  // namespace

/// Only one of y and −y is needed: it is, after scaling, on a face where some y_s = v_s.
bool TouchedRows::has_no_null_vector(const std::vector<double>& v) const {
  const bool is_pose =
      std::all_of(moving_.begin(), moving_.end(), [this](std::size_t p) { return r_[p] == 0.0; });
  const std::size_t most = is_pose ? kMostDirectionsOfAPose : kMostDirections;
  std::vector<Directions> waiting;
  for (std::size_t s = 0; s < order(); ++s) {
    waiting.push_back({std::vector<double>(order(), 0.0), v});
    std::swap(waiting.back().middle[s], waiting.back().radius[s]);
  }
  for (std::size_t boxes = 0; !waiting.empty(); ++boxes) {
    Directions y = std::move(waiting.back());
    waiting.pop_back();
    if (has_no_null_vector(y)) continue;
    std::size_t widest = 0;
    for (std::size_t s = 1; s < order(); ++s)
      if (y.radius[s] * v[widest] > y.radius[widest] * v[s]) widest = s;
    if (boxes > most || y.radius[widest] < kNarrowestRadius * v[widest]) return false;
    const double half = y.radius[widest] = 0.5 * kOutward * y.radius[widest];
    waiting.push_back(y);
    waiting.back().middle[widest] -= half;
    y.middle[widest] += half;
    waiting.push_back(std::move(y));
  }
  return true;
}

bool TouchedRows::has_no_null_vector(Directions& y) const {
  const Effects x = effects(y);
  for (std::size_t s = 0; s < order(); ++s) {
    const double middle = y.middle[s], radius = y.radius[s];
    // A null vector can have y_s only between these bounds: it is −(Σ δ_kx_k + Σ δ_jδ_kx_jk), or
    // Σ δ_kx_k − Σ δ_jδ_kx_jk with −δ in the place of δ.
    double lo = down(middle - radius), hi = up(middle + radius);
    if (lo < 0.0) lo = std::max(lo, -bound_of_row(s, x, 1.0));
    if (hi > 0.0) hi = std::min(hi, bound_of_row(s, x, -1.0));
    if (lo > hi) return true;
    const double rest = 0.5 * kOutward * up(hi - lo) + 0x1p-50 * (std::fabs(lo) + std::fabs(hi));
    if (rest < 0.9 * radius) y.middle[s] = 0.5 * lo + 0.5 * hi, y.radius[s] = rest;
  }
  return false;
}

}  // namespace regulus::verifier
