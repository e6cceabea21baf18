// SPDX-License-Identifier: Apache-2.0
// How boxes are narrowed to the solutions in them, and shown to have regular ones alone.
#include <algorithm>

#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/quotients.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {

/// From v + M(p − c) = 0, row by row: p_j − c_j = −(v_i + Σ_{k≠j} M_ik(p_k − c_k))/M_ij.
bool BranchTest::narrow_by_rows(const Values& values, const Values& M,
                                const std::vector<double>& center, Box& unknowns) const {
  std::vector<Interval> step;
  for (std::size_t k = 0; k < n_; ++k) step.push_back(unknowns[k] - point(center[k]));
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) {
      Interval rest = values[i];
      for (std::size_t k = 0; k < n_; ++k)
        if (k != j) rest = rest + M[i * n_ + k] * step[k];
      if (!is_bounded(rest)) continue;
      if (!narrow_to_quotients(-rest, M[i * n_ + j], step[j])) return false;
      const Interval left = step[j] + point(center[j]);
      unknowns[j] = {std::max(unknowns[j].lo, left.lo), std::min(unknowns[j].hi, left.hi)};
      if (!(unknowns[j].lo <= unknowns[j].hi)) return false;
    }
  return true;
}

/// The second derivative of equation j by two variables or unknowns.
Interval BranchTest::second_at(std::size_t j, std::size_t a, std::size_t b) const {
  const std::size_t triangle = all_ * (all_ + 1) / 2, row = std::min(a, b), column = std::max(a, b);
  return second_values_[j * triangle + row * all_ - row * (row + 1) / 2 + column];
}

/// Encloses the means of Φ_p along the segments from c: those over the box, and those at c and half of
/// what they change by. Φ_p(c + td) is in Φ_p(c) + t·H·d, with H in the enclosure over the box, and the
/// mean of t is 1/2.
BranchTest::Values BranchTest::mean_derivatives(const std::vector<Interval>& step) const {
  Values M;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t l = 0; l < n_; ++l) {
      Interval over = first_values_[j * all_ + m_ + l];
      if (!second_values_.empty()) {
        Interval near = center_[j * all_ + m_ + l], change;
        for (std::size_t k = 0; k < n_; ++k) change = change + second(j, k, l) * step[k];
        near = near + 0.5 * change;
        if (is_bounded(near)) over = {std::max(over.lo, near.lo), std::min(over.hi, near.hi)};
      }
      M.push_back(over);
    }
  return M;
}

/// |I − KΦ_p|r < r in every component, with r > 0 and K an inverse in the middle. Any r would be as sound:
/// the powers of the matrix lead to one that is nearly an eigenvector.
bool BranchTest::is_regular(const Box& places, const Box& unknowns) {
  constexpr int kMostPowers = 8;
  constexpr double kLeastPart = 0x1p-20;
  whole_ = places;
  whole_.insert(whole_.end(), unknowns.begin(), unknowns.end());
  tube_ = nullptr;
  has_rates_ = false;
  if (!take(*over_, first_, whole_, first_values_)) return false;
  std::vector<double> A, E, r(n_, 1.0);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t l = 0; l < n_; ++l) A.push_back(mid(first_values_[j * all_ + m_ + l]));
  if (!approx_left_inverse(A, n_, n_, K_) || !is_moderate(K_)) return false;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t l = 0; l < n_; ++l) E.push_back(left_side(i, first_values_, m_ + l));
  if (!is_moderate(E)) return false;
  for (int step = 0; step < kMostPowers; ++step) {
    std::vector<double> next;
    bool is_less = true;
    for (std::size_t i = 0; i < n_; ++i) {
      Interval sum;
      for (std::size_t l = 0; l < n_; ++l) sum = sum + point(E[i * n_ + l]) * point(r[l]);
      is_less = is_less && sum.hi < r[i];
      next.push_back(sum.hi);
    }
    if (is_less) return true;
    const double largest = std::ranges::max(next);
    for (std::size_t i = 0; i < n_; ++i) r[i] = next[i] / largest + kLeastPart;
  }
  return false;
}

}  // namespace regulus::verifier
