// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/moving_inverse.hpp"

#include <algorithm>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {

constexpr std::size_t kMostWork = 1 << 22;  ///< most numbers for one box

MovingInverse::MovingInverse(Question& question, std::vector<std::size_t> moving)
    : q_(question), n_(question.columns), moving_(std::move(moving)), A_(question.matrix.size()) {
  differentiate();
  std::vector<NodeId> middle = q_.matrix, over;
  for (const MovingTerm& t : terms_) {
    middle.push_back(t.term.monomial);
    middle.insert(middle.end(), t.first.begin(), t.first.end());
    over.insert(over.end(), t.second.begin(), t.second.end());
    for (const Coefficient& c : t.term.coefficients) middle.push_back(c.node);
  }
  at_middle_.emplace(q_, middle);
  over_box_.emplace(q_, over);
  for (Matrix* matrix : {&X_, &P_, &e_, &first_, &Z_, &C_, &unsure_}) matrix->resize(n_ * n_);
  for (auto* matrices : {&D_, &s_, &share_}) matrices->assign(moving_.size(), Matrix(n_ * n_));
}

void MovingInverse::differentiate() {
  std::vector<Differentiator> by;
  for (const std::size_t p : moving_) by.emplace_back(q_.graph, p);
  for (Term& term : expand(q_.graph, q_.matrix, moving_, q_.variables.size())) {
    MovingTerm& t = terms_.emplace_back();
    t.term = std::move(term);
    t.KC.resize(n_ * n_);
    t.unsure.resize(n_ * n_);
    for (const Coefficient& c : t.term.coefficients)
      if (std::find(t.columns.begin(), t.columns.end(), c.entry % n_) == t.columns.end())
        t.columns.push_back(c.entry % n_);
    for (std::size_t p = 0; p < moving_.size(); ++p) {
      t.first.push_back(by[p].of(t.term.monomial));
      for (std::size_t q = 0; q <= p; ++q)
        t.second.push_back(t.first[p] == kNoNode ? kNoNode : by[q].of(t.first[p]));
    }
    if (terms_.size() > kMostTerms || terms_.size() * (t.second.size() + n_ * n_) > kMostWork)
      throw Unfinished("the matrix has too many terms in too many variables");
  }
}

bool MovingInverse::run(const Box& box, const Box& middle, const std::vector<double>& r) {
  if (!at_middle_->run(middle) || !over_box_->run(box) || !find_inverse() || !bound_middle())
    return false;
  for (Matrix* matrix : {&X_, &first_, &Z_}) std::fill(matrix->begin(), matrix->end(), 0.0);
  P_ = e_;
  for (std::size_t p = 0; p < moving_.size(); ++p)
    if (!bound_slope(p, r[moving_[p]])) return false;
  for (std::size_t p = 0; p < moving_.size(); ++p)
    for (std::size_t q = 0; q <= p; ++q)
      if (!bound_pair(p, q, r[moving_[p]] * r[moving_[q]] * (p == q ? 0.5 : 1.0))) return false;
  add_remainders();
  return is_moderate(X_);
}

bool MovingInverse::find_inverse() {
  for (std::size_t e = 0; e < A_.size(); ++e) A_[e] = mid(at_middle_->value(q_.matrix[e]));
  return approx_left_inverse(A_, q_.rows, n_, K_) && is_moderate(K_);
}

/// Computes K·C_μ.
bool MovingInverse::multiply(MovingTerm& t) {
  for (const std::size_t j : t.columns) {
    std::fill_n(&t.KC[j * n_], n_, 0.0);
    std::fill_n(&t.unsure[j * n_], n_, 0.0);
  }
  for (const Coefficient& c : t.term.coefficients) {
    const Interval value = at_middle_->value(c.node);
    if (mag(value) > kLargest) return false;
    const double x = mid(value), spread = radius_ru(value, x) + kRounding * std::fabs(x);
    const std::size_t row = c.entry / n_, column = c.entry % n_ * n_;
    for (std::size_t i = 0; i < n_; ++i) {
      t.KC[column + i] += K_[row * n_ + i] * x;
      t.unsure[column + i] += std::fabs(K_[row * n_ + i]) * spread;
    }
  }
  t.spread = t.size = 0.0;
  return true;
}

/// Adds K·C_μ·value to a sum, and a bound of its uncertainty to `unsure`.
bool MovingInverse::add(const MovingTerm& t, Interval value, Matrix& sum, Matrix& unsure) const {
  if (is_zero(value)) return true;
  const double x = mid(value), spread = radius_ru(value, x) + kRounding * std::fabs(x);
  for (const std::size_t j : t.columns)
    for (std::size_t e = j * n_; e < (j + 1) * n_; ++e) {
      sum[e] += t.KC[e] * x;
      unsure[e] += std::fabs(t.KC[e]) * spread + t.unsure[e] * (std::fabs(x) + spread);
    }
  return mag(value) <= kLargest;
}

/// Bounds e and all quantities that do not change within the box.
bool MovingInverse::bound_middle() {
  for (Matrix* matrix : {&C_, &unsure_}) std::fill(matrix->begin(), matrix->end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) C_[i * n_ + i] = -1.0, unsure_[i * n_ + i] = kRounding;
  for (MovingTerm& t : terms_)
    if (!multiply(t) || !add(t, at_middle_->value(t.term.monomial), C_, unsure_)) return false;
  for (std::size_t e = 0; e < e_.size(); ++e) e_[e] = inflate(std::fabs(C_[e]) + unsure_[e]);
  return true;
}

/// Bounds B_p at the middle, takes D_p in it, and bounds r_p|B_p − D_p|.
bool MovingInverse::bound_slope(std::size_t p, double r) {
  for (Matrix* matrix : {&D_[p], &s_[p], &share_[p]})
    std::fill(matrix->begin(), matrix->end(), 0.0);
  for (const MovingTerm& t : terms_)
    if (!add(t, at_middle_->value(t.first[p]), D_[p], s_[p])) return false;
  for (std::size_t e = 0; e < n_ * n_; ++e) {
    s_[p][e] = inflate(s_[p][e]);
    first_[e] += r * s_[p][e];
    X_[e] += r * std::fabs(D_[p][e]);
  }
  return true;
}

/// Bounds r_pr_q|∂_p∂_qKA − D_pB_q − D_qB_p|, without the uncertainty of ∂_p∂_qKA and of the B.
bool MovingInverse::bound_pair(std::size_t p, std::size_t q, double weight) {
  const std::size_t pair = p * (p + 1) / 2 + q;
  std::fill(C_.begin(), C_.end(), 0.0);
  for (MovingTerm& t : terms_) {
    const Interval second = over_box_->value(t.second[pair]);
    if (is_zero(second)) continue;
    if (mag(second) > kLargest) return false;
    const double x = mid(second);
    t.spread += weight * (radius_ru(second, x) + kRounding * std::fabs(x));
    t.size += weight * std::fabs(x);
    for (const std::size_t j : t.columns)
      for (std::size_t e = j * n_; e < (j + 1) * n_; ++e) C_[e] += t.KC[e] * x;
  }
  for (std::size_t e = 0; e < n_ * n_; ++e) Z_[e] += weight * std::fabs(C_[e]);
  subtract_product(D_[p], D_[q]);
  subtract_product(D_[q], D_[p]);
  for (std::size_t e = 0; e < n_ * n_; ++e) {
    const double bound = weight * std::fabs(C_[e]);
    P_[e] += bound, share_[p][e] += bound, share_[q][e] += bound;
  }
  return true;
}

void MovingInverse::subtract_product(const Matrix& D, const Matrix& B) {
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = 0; i < n_; ++i) C_[j * n_ + i] -= D[k * n_ + i] * B[j * n_ + k];
}

/// Adds the terms that the pairs leave out: Σ r_p|B_p − D_p|, and X(e + Σ r_p|B_p − D_p| + Z). The
/// roundings of the products D_pB_q are covered by X·kRounding·X.
void MovingInverse::add_remainders() {
  std::fill(unsure_.begin(), unsure_.end(), 0.0);
  for (const MovingTerm& t : terms_)
    for (const std::size_t j : t.columns)
      for (std::size_t e = j * n_; e < (j + 1) * n_; ++e)
        unsure_[e] += std::fabs(t.KC[e]) * t.spread + t.unsure[e] * (t.size + t.spread);
  for (std::size_t e = 0; e < n_ * n_; ++e) {
    X_[e] = inflate(X_[e]);
    C_[e] = e_[e] + first_[e] + Z_[e] + unsure_[e] + kRounding * X_[e];
    P_[e] += first_[e] + unsure_[e];
  }
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = 0; i < n_; ++i) P_[j * n_ + i] += X_[k * n_ + i] * C_[j * n_ + k];
  for (double& bound : P_) bound = inflate(bound);
}

}  // namespace regulus::verifier
