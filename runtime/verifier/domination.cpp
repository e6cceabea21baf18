// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/domination.hpp"

#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfComparison = 64;
constexpr int kSweeps = 40;  ///< of the power iteration
constexpr int kSeriesTerms = 6;

}  // namespace

/// Returns false if any bound is NaN or infinite.
bool Domination::holds() const noexcept {
  for (std::size_t i = 0; i < n_; ++i)
    if (!(Tv_[i] < v_[i]) || !(v_[i] < kLargest)) return false;
  return true;
}

void Domination::multiply() {
  std::fill(Tv_.begin(), Tv_.end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) Tv_[i] += (*T_)[j * n_ + i] * v_[j];
  for (double& x : Tv_) x = inflate(x);
}

/// The sum of the old and the new vector prevents cycles of the power iteration.
bool Domination::find(const Matrix& T) {
  T_ = &T;
  std::fill(v_.begin(), v_.end(), 1.0);
  for (int sweep = 0;; ++sweep) {
    multiply();
    if (holds()) return true;
    double largest = 0.0;
    for (std::size_t i = 0; i < n_; ++i) largest = std::max(largest, v_[i] + Tv_[i]);
    if (sweep == kSweeps || !(largest < kLargest)) return false;
    for (std::size_t i = 0; i < n_; ++i) v_[i] = std::max((v_[i] + Tv_[i]) / largest, 0x1p-100);
  }
}

/// For any g, Tg + c − g ≤ β(v − Tv) shows that g + βv is such an x. g is a part of Σ Tʲc.
void Domination::bound_solution(const double* c, double* x) const {
  std::vector<double> g(c, c + n_), next(n_);
  for (int term = 0;; ++term) {
    next.assign(c, c + n_);
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) next[i] += (*T_)[j * n_ + i] * g[j];
    if (term == kSeriesTerms) break;
    g = next;
  }
  double beta = 0.0;
  for (std::size_t i = 0; i < n_; ++i)
    beta = std::max(beta, up(up(inflate(next[i]) - g[i]) / down(v_[i] - Tv_[i])));
  for (std::size_t i = 0; i < n_; ++i) x[i] = up(g[i] + up(beta * v_[i]));
}

Interval Domination::determinant() const {
  std::vector<Ball> comparison;
  for (std::size_t e = 0; e < n_ * n_; ++e)
    comparison.emplace_back(point(e % (n_ + 1) == 0 ? 1.0 : 0.0) - point((*T_)[e]),
                            kBitsOfComparison);
  return verifier::determinant(comparison, n_, kBitsOfComparison).enclosure();
}

}  // namespace regulus::verifier
