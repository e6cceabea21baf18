// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/touched_rows.hpp"

#include <algorithm>

#include "runtime/certificate/verifier/derivative.hpp"
#include "runtime/certificate/verifier/rounding.hpp"

namespace regulus::verifier {

TouchedRows::TouchedRows(Question& question, const Variety& variety,
                         const std::vector<std::size_t>& moving)
    : q_(question),
      variety_(variety),
      moving_(moving),
      n_(question.columns),
      whole_(question.balls.size()),
      w_(n_),
      g_(n_),
      drift_(n_),
      Y_(n_) {
  find_quantities();
  find_groups();
  std::vector<NodeId> middle, over;
  for (const Quantity& quantity : quantities_) {
    middle.insert(middle.end(), quantity.w.begin(), quantity.w.end());
    for (const auto& nodes : quantity.by_moving)
      over.insert(over.end(), nodes.begin(), nodes.end());
    for (const auto& [other, nodes] : quantity.by_quantity)
      over.insert(over.end(), nodes.begin(), nodes.end());
  }
  at_middle_.emplace(q_, middle);
  over_box_.emplace(q_, over);
  for (Matrix* matrix : {&K_, &moved_, &unsure_, &G_}) matrix->resize(n_ * order());
  DK_.assign(moving_.size(), Matrix(n_ * order()));
  T_.resize(order() * order());
}

void TouchedRows::find_quantities() {
  std::vector<Differentiator> by;
  for (std::size_t k = 0; k < q_.variables.size(); ++k) by.emplace_back(q_.graph, k);
  const auto derivatives = [&](std::size_t variable, const std::vector<NodeId>& nodes) {
    std::vector<NodeId> result;
    for (const NodeId node : nodes)
      result.push_back(node == kNoNode ? kNoNode : by[variable].of(node));
    return result;
  };
  for (std::size_t k = 0; k < q_.variables.size(); ++k) {
    if (std::find(moving_.begin(), moving_.end(), k) != moving_.end()) continue;
    for (std::size_t row = 0; row < q_.rows; ++row) {
      const auto first = q_.matrix.begin() + std::ptrdiff_t(row * n_);
      const auto w = derivatives(k, {first, first + std::ptrdiff_t(n_)});
      if (std::all_of(w.begin(), w.end(), [](NodeId node) { return node == kNoNode; })) continue;
      const auto slot = std::size_t(std::find(rows_.begin(), rows_.end(), row) - rows_.begin());
      if (slot == rows_.size()) rows_.push_back(row);
      quantities_.push_back({k, slot, w, {}, {}, {}, {}, {}});
    }
  }
  for (Quantity& quantity : quantities_) {
    for (const std::size_t p : moving_) quantity.by_moving.push_back(derivatives(p, quantity.w));
    for (const Quantity& other : quantities_)
      if (other.slot == quantity.slot)
        quantity.by_quantity.emplace_back(other.variable, derivatives(other.variable, quantity.w));
    quantity.b.resize(order());
    quantity.S.resize(order());
    quantity.followed.assign(moving_.size(), std::vector<double>(order()));
  }
}

void TouchedRows::find_groups() {
  for (std::size_t k = 0; k < quantities_.size(); ++k) {
    std::optional<std::size_t> ball;
    for (std::size_t b = 0; b < q_.balls.size(); ++b)
      for (const std::size_t member : q_.balls[b].members)
        if (member == quantities_[k].variable) ball = b;
    const std::size_t slot = quantities_[k].slot;
    const auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
      return ball && group.ball == ball && group.slot == slot;
    });
    if (same != groups_.end())
      same->members.push_back(k);
    else
      groups_.push_back({slot, ball, {k}});
  }
}

bool TouchedRows::run(const Box& box, const Box& middle, const std::vector<double>& r,
                      const MovingInverse& inverse, const Domination& domination) {
  r_ = r;
  for (std::size_t b = 0; b < q_.balls.size(); ++b)
    whole_[b] =
        std::all_of(q_.balls[b].members.begin(), q_.balls[b].members.end(), [&](std::size_t k) {
          return box[k].lo == variety_.outer[k].lo && box[k].hi == variety_.outer[k].hi;
        });
  if (!at_middle_->run(middle) || !over_box_->run(box)) return false;
  bound_K(inverse, domination);
  if (!is_moderate(moved_) || !is_moderate(G_)) return false;
  for (Quantity& quantity : quantities_)
    if (!bound_quantity(quantity, inverse)) return false;
  std::fill(T_.begin(), T_.end(), 0.0);
  for (const Group& group : groups_)
    for (std::size_t c = 0; c < order(); ++c)
      T_[c * order() + group.slot] += bound_group(group, [c](const Quantity& quantity) {
        return std::fabs(quantity.b[c]) + quantity.S[c];
      });
  for (double& bound : T_) bound = inflate(bound);
  return true;
}

/// Bounds K(t) = K − Σ τ_pD_pK on these columns; finds G with |x| ≤ G|y| if (I + E)x = K(t)y.
void TouchedRows::bound_K(const MovingInverse& inverse, const Domination& domination) {
  std::fill(moved_.begin(), moved_.end(), 0.0);
  std::fill(unsure_.begin(), unsure_.end(), 0.0);
  for (std::size_t s = 0; s < order(); ++s) {
    const double* K = &inverse.K()[rows_[s] * n_];
    std::copy(K, K + n_, &K_[s * n_]);
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i)
        unsure_[s * n_ + i] += kRounding * inverse.X()[j * n_ + i] * std::fabs(K[j]);
    for (std::size_t p = 0; p < moving_.size(); ++p) {
      double* DK = &DK_[p][s * n_];
      std::fill(DK, DK + n_, 0.0);
      for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t i = 0; i < n_; ++i) DK[i] += inverse.D(p)[j * n_ + i] * K[j];
      for (std::size_t i = 0; i < n_; ++i) moved_[s * n_ + i] += r_[moving_[p]] * std::fabs(DK[i]);
    }
    std::vector<double> size(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      unsure_[s * n_ + i] = inflate(unsure_[s * n_ + i]);
      moved_[s * n_ + i] = inflate(moved_[s * n_ + i] + unsure_[s * n_ + i]);
      size[i] = inflate(std::fabs(K[i]) + moved_[s * n_ + i]);
    }
    domination.bound_solution(size.data(), &G_[s * n_]);
  }
}

/// Computes b = w̄ᵀK, and S for the rest of w(t)ᵀK(t) + (w(t)ᵀE + (w − w(t))ᵀ)(I + E)⁻¹K(t). Here
/// w(t) = w̄ + Σ τ_pg_p follows w, drift is Σ r_p|g_p|, and Y bounds the factor before (I + E)⁻¹.
bool TouchedRows::bound_quantity(Quantity& k, const MovingInverse& inverse) {
  std::fill(k.S.begin(), k.S.end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval w = at_middle_->value(k.w[j]);
    if (mag(w) > kLargest) return false;
    w_[j] = mid(w);
    Y_[j] = radius_ru(w, w_[j]);
    drift_[j] = 0.0;
    for (const auto& [other, nodes] : k.by_quantity)
      Y_[j] += r_[other] * mag(over_box_->value(nodes[j]));
  }
  for (std::size_t p = 0; p < moving_.size(); ++p) {
    const double r = r_[moving_[p]];
    for (std::size_t j = 0; j < n_; ++j) {
      const Interval g = over_box_->value(k.by_moving[p][j]);
      if (mag(g) > kLargest) return false;
      g_[j] = mid(g);
      Y_[j] += r * radius_ru(g, g_[j]);
      drift_[j] += r * std::fabs(g_[j]);
    }
    for (std::size_t s = 0; s < order(); ++s) {
      double sum = 0.0;
      for (std::size_t j = 0; j < n_; ++j)
        sum += g_[j] * K_[s * n_ + j] - w_[j] * DK_[p][s * n_ + j];
      k.followed[p][s] = r * std::fabs(sum);
      k.S[s] += k.followed[p][s];
    }
  }
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i)
      Y_[j] += (std::fabs(w_[i]) + drift_[i]) * inverse.P()[j * n_ + i];
  for (std::size_t s = 0; s < order(); ++s) {
    k.b[s] = 0.0;
    for (std::size_t j = 0; j < n_; ++j) {
      const std::size_t e = s * n_ + j;
      const double w = std::fabs(w_[j]);
      k.b[s] += w_[j] * K_[e];
      k.S[s] += drift_[j] * moved_[e] + Y_[j] * G_[e] + w * unsure_[e] +
                kRounding * (w + drift_[j]) * (std::fabs(K_[e]) + moved_[e]);
    }
    k.S[s] = inflate(k.S[s]);
  }
  return true;
}

void TouchedRows::add_impacts(const std::vector<double>& v, std::vector<double>& impact) const {
  for (const Quantity& k : quantities_)
    for (std::size_t s = 0; s < order(); ++s) {
      const double weight = r_[k.variable] * v[s] / v[k.slot];
      impact[k.variable] += weight * (std::fabs(k.b[s]) + k.S[s]);
      for (std::size_t p = 0; p < moving_.size(); ++p)
        impact[moving_[p]] += weight * k.followed[p][s];
    }
}

}  // namespace regulus::verifier
