// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/touched_rows.hpp"

#include <algorithm>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/rounding.hpp"

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
  find_products();
  find_couplings();
  std::vector<NodeId> middle, over;
  for (const Quantity& quantity : quantities_) {
    middle.insert(middle.end(), quantity.w.begin(), quantity.w.end());
    for (const auto& nodes : quantity.by_moving)
      over.insert(over.end(), nodes.begin(), nodes.end());
  }
  for (const Products& products : products_)
    for (const Product& product : products.members)
      over.insert(over.end(), product.H.begin(), product.H.end());
  at_middle_.emplace(q_, middle);
  over_box_.emplace(q_, over);
  for (Matrix* matrix : {&K_, &moved_, &unsure_, &G_}) matrix->resize(n_ * order());
  DK_.assign(moving_.size(), Matrix(n_ * order()));
  T_.resize(order() * order());
}

namespace {

bool has_any(const std::vector<NodeId>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [](NodeId node) { return node != kNoNode; });
}

std::vector<NodeId> derivatives(Differentiator& by, const std::vector<NodeId>& nodes) {
  std::vector<NodeId> result;
  for (const NodeId node : nodes) result.push_back(node == kNoNode ? kNoNode : by.of(node));
  return result;
}

}  // namespace

void TouchedRows::find_quantities() {
  std::vector<Differentiator> by;
  for (std::size_t k = 0; k < q_.variables.size(); ++k) by.emplace_back(q_.graph, k);
  for (std::size_t k = 0; k < q_.variables.size(); ++k) {
    if (std::find(moving_.begin(), moving_.end(), k) != moving_.end()) continue;
    for (std::size_t row = 0; row < q_.rows; ++row) {
      const auto first = q_.matrix.begin() + std::ptrdiff_t(row * n_);
      const auto w = derivatives(by[k], {first, first + std::ptrdiff_t(n_)});
      if (!has_any(w)) continue;
      const auto slot = std::size_t(std::find(rows_.begin(), rows_.end(), row) - rows_.begin());
      if (slot == rows_.size()) rows_.push_back(row);
      quantities_.push_back({k, slot, w, {}, {}});
    }
  }
  for (Quantity& quantity : quantities_) {
    for (const std::size_t p : moving_)
      quantity.by_moving.push_back(derivatives(by[p], quantity.w));
    resize(quantity.coefficient);
  }
}

void TouchedRows::resize(Coefficient& coefficient) const {
  coefficient.b.resize(order());
  coefficient.S.resize(order());
  coefficient.followed.assign(moving_.size(), std::vector<double>(order()));
}

void TouchedRows::find_products() {
  for (std::size_t a = 0; a < groups_.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      if (groups_[a].slot != groups_[b].slot) continue;
      Products products{a, b, {}, false};
      for (std::size_t i = 0; i < groups_[a].members.size(); ++i)
        for (std::size_t j = 0; j < (a == b ? i + 1 : groups_[b].members.size()); ++j) {
          const Quantity& first = quantities_[groups_[a].members[i]];
          Differentiator by(q_.graph, quantities_[groups_[b].members[j]].variable);
          std::vector<NodeId> H = derivatives(by, first.w);
          if (!has_any(H)) continue;
          products.members.push_back({i, j, std::move(H), {}});
          resize(products.members.back().coefficient);
        }
      if (!products.members.empty()) products_.push_back(std::move(products));
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
      groups_.push_back({slot, ball, {k}, false});
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
  for (Products& products : products_)
    for (Product& product : products.members)
      if (!bound_product(product, inverse)) return false;
  for (std::size_t c = 0; c < order(); ++c) {
    std::vector<double> most(order(), 0.0);
    add_bounds(
        [c](const Coefficient& k) {
          return Estimate{0.0, std::fabs(k.b[c]) + k.S[c]};
        },
        most);
    for (std::size_t s = 0; s < order(); ++s) T_[c * order() + s] = inflate(most[s]);
  }
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

/// Bounds the coefficient of δ_k. w(t) = w̄ + Σ τ_pg_p follows the derivative w at ū, drift is Σ
/// r_p|g_p|, and Y bounds |w − w(t)|.
bool TouchedRows::bound_quantity(Quantity& k, const MovingInverse& inverse) {
  std::fill(k.coefficient.S.begin(), k.coefficient.S.end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval w = at_middle_->value(k.w[j]);
    if (mag(w) > kLargest) return false;
    w_[j] = mid(w);
    Y_[j] = radius_ru(w, w_[j]);
    drift_[j] = 0.0;
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
    follow(k.coefficient, p);
  }
  bound(k.coefficient, inverse);
  return true;
}

/// Bounds the coefficient of δ_jδ_k: the same with w = H, which nothing follows.
bool TouchedRows::bound_product(Product& product, const MovingInverse& inverse) {
  std::fill(product.coefficient.S.begin(), product.coefficient.S.end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval H = over_box_->value(product.H[j]);
    if (mag(H) > kLargest) return false;
    w_[j] = mid(H);
    Y_[j] = radius_ru(H, w_[j]);
    drift_[j] = g_[j] = 0.0;
  }
  for (std::size_t p = 0; p < moving_.size(); ++p) follow(product.coefficient, p);
  bound(product.coefficient, inverse);
  return true;
}

/// Adds r_p|(g_pᵀ − w̄ᵀD_p)K| to S.
void TouchedRows::follow(Coefficient& k, std::size_t p) {
  for (std::size_t s = 0; s < order(); ++s) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n_; ++j) sum += g_[j] * K_[s * n_ + j] - w_[j] * DK_[p][s * n_ + j];
    k.followed[p][s] = r_[moving_[p]] * std::fabs(sum);
    k.S[s] += k.followed[p][s];
  }
}

/// Computes b = w̄ᵀK, and S for the rest of w(t)ᵀK(t) + (w(t)ᵀE + (w − w(t))ᵀ)(I + E)⁻¹K(t).
void TouchedRows::bound(Coefficient& k, const MovingInverse& inverse) {
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
}

/// Bounds |Σ δ_kx_k| over the values of the group. If a split has cut a ball, the box around the
/// rest of the ball is used.
double TouchedRows::bound_of(const Group& group, const std::vector<Estimate>& x) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double value = x[k].magnitude();
    sum += is_ball(group) ? value * value : spread(group, k) * value;
  }
  return is_ball(group) ? variety_.reach[*group.ball] * std::sqrt(sum) : sum;
}

/// Bounds |Σ δ_jδ_kx_jk|, where a square δ_k²x_kk has the factor ½. PROOF.md, "The test", 2.
double TouchedRows::bound_of(const Products& products, const std::vector<Estimate>& x) const {
  const Group &a = groups_[products.first], &b = groups_[products.second];
  const bool same = products.first == products.second;
  if (!is_ball(a) || !is_ball(b)) {
    double sum = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const auto& [i, j, H, coefficient] = products.members[k];
      sum += (same && i == j ? 0.5 : 1.0) * spread(a, i) * spread(b, j) * x[k].magnitude();
    }
    return sum;
  }
  const double weight = variety_.reach[*a.ball] * variety_.reach[*b.ball];
  double squares = 0.0;
  if (same) {
    for (const Estimate& estimate : x) squares += estimate.magnitude() * estimate.magnitude();
    return weight * std::sqrt(0.5 * squares);
  }
  std::vector<double> X(a.members.size() * b.members.size(), 0.0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& [i, j, H, coefficient] = products.members[k];
    X[i * b.members.size() + j] = x[k].middle;
    squares += x[k].radius * x[k].radius;
  }
  return weight * (spectral_norm(X, a.members.size(), b.members.size()) + std::sqrt(squares));
}

void TouchedRows::add_impacts(const std::vector<double>& v, std::vector<double>& impact) const {
  const auto add = [&](const Coefficient& k, std::size_t slot, double weight,
                       std::initializer_list<std::size_t> variables) {
    for (std::size_t s = 0; s < order(); ++s) {
      const double share = weight * v[s] / v[slot];
      for (const std::size_t variable : variables)
        impact[variable] += share * (std::fabs(k.b[s]) + k.S[s]);
      for (std::size_t p = 0; p < moving_.size(); ++p)
        impact[moving_[p]] += share * k.followed[p][s];
    }
  };
  for (const Quantity& k : quantities_) add(k.coefficient, k.slot, r_[k.variable], {k.variable});
  for (const Products& products : products_)
    for (const Product& product : products.members) {
      const Quantity& j = quantities_[groups_[products.first].members[product.first]];
      const Quantity& k = quantities_[groups_[products.second].members[product.second]];
      add(product.coefficient, j.slot, r_[j.variable] * r_[k.variable], {j.variable, k.variable});
    }
}

}  // namespace regulus::verifier
