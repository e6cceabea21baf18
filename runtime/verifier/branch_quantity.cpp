// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_quantity.hpp"

#include <algorithm>
#include <string>

#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfQuantity = 128;

/// Encloses a constant that is at least 0, or positive.
Interval size_of(const Graph& graph, NodeId node, bool is_positive) {
  const auto value = evaluate(graph, {node}, {}, kBitsOfQuantity);
  const Interval x = value ? (*value)[0].enclosure() : everything();
  if (!is_bounded(x) || (is_positive ? !(x.lo > 0.0) : !(x.lo >= 0.0)))
    throw Unfinished("a number of the quantity is not certainly " +
                     std::string(is_positive ? "positive" : "0 or positive"));
  return x;
}

std::vector<Interval> sizes_of(const Graph& graph, const std::vector<NodeId>& nodes,
                               bool is_positive) {
  std::vector<Interval> result;
  for (const NodeId node : nodes) result.push_back(size_of(graph, node, is_positive));
  return result;
}

Interval constant_of(const Graph& graph, NodeId node) {
  const auto value = evaluate(graph, {node}, {}, kBitsOfQuantity);
  const Interval x = value ? (*value)[0].enclosure() : everything();
  if (!is_bounded(x)) throw Unfinished("a number of the quantity has no certain value");
  return x;
}

Interval magnitude(Interval x) { return {mig(x), mag(x)}; }

}  // namespace

BranchQuantity::BranchQuantity(Question& q)
    : quantity_(*q.quantity),
      n_(q.closure->equations.size()),
      motors_(q.closure->poses.size()),
      by_motor_(q, q.quantity->by_motor) {
  const QuantityLines& lines = quantity_;
  if (is_singular_value(lines.kind)) {
    singular_values_.emplace(q);
    return;
  }
  if (lines.bound != kNoNode) bound_ = constant_of(q.graph, lines.bound);
  for (const NodeId node : lines.least) least_.push_back(constant_of(q.graph, node));
  for (const NodeId node : lines.largest) largest_.push_back(constant_of(q.graph, node));
  of_motors_ = sizes_of(q.graph, lines.stiffness, true);
  for (const auto* list : {&lines.errors, &lines.speeds})
    if (!list->empty()) of_motors_ = sizes_of(q.graph, *list, false);
  factors_ = sizes_of(q.graph, lines.factors, true);
  if (!lines.set) return;
  for (const NodeId node : lines.set->middle) middle_.push_back(constant_of(q.graph, node));
  spread_ = sizes_of(q.graph, lines.set->spread, false);
  for (const WrenchBall& ball : lines.set->balls)
    balls_.push_back({size_of(q.graph, ball.radius, false), ball.members});
}

/// The largest value of all loads and errors; of a least one −q.
bool BranchQuantity::keeps_bound(BranchTest& test) {
  if (singular_values_) return singular_values_->keeps_bound(test);
  if (!least_.empty()) {
    const std::vector<Work> all = forces(test);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Interval most = all[k].middle + all[k].spread, least = all[k].middle - all[k].spread;
      if (!is_bounded(most) || !is_bounded(least)) return false;
      if (!(most.hi <= largest_[k].lo && least.lo >= least_[k].hi)) return false;
    }
    return !all.empty();
  }
  const Interval f = largest(test);
  return is_bounded(f) && f.hi < (quantity_.side == format::kLeast ? -bound_.hi : bound_.lo);
}

bool BranchQuantity::attains_bound(const BranchTest& test) {
  if (singular_values_) return singular_values_->attains_bound(test);
  if (!least_.empty()) {
    const std::vector<Work> all = forces(test);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Interval most = all[k].middle + all[k].spread, least = all[k].middle - all[k].spread;
      if (is_bounded(most) && most.lo > largest_[k].hi) return true;
      if (is_bounded(least) && least.hi < least_[k].lo) return true;
    }
    return false;
  }
  const Interval f = largest(test);
  return is_bounded(f) && f.lo >= (quantity_.side == format::kLeast ? -bound_.lo : bound_.hi);
}

/// (I + E)⁻¹ is bounded by (I − P)⁻¹ if P is dominated.
std::optional<Domination> BranchQuantity::dominate(const BranchTest& test) {
  P_.assign(n_ * n_, 0.0);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t l = 0; l < n_; ++l) {
      Interval sum;
      for (std::size_t j = 0; j < n_; ++j) sum = sum + test.inverse(i, j) * test.derivative(j, l);
      P_[l * n_ + i] = mag(i == l ? sum - point(1.0) : sum);
    }
  if (!is_moderate(P_)) return std::nullopt;
  Domination domination(n_);
  return domination.find(P_) ? std::optional(std::move(domination)) : std::nullopt;
}

/// Encloses J = −Φ_p⁻¹B: with J₀ = −KB near the middle, |J − J₀| ≤ (I − P)⁻¹|K(B + Φ_pJ₀)|.
std::vector<Interval> BranchQuantity::derivatives(const BranchTest& test,
                                                  const Domination& domination,
                                                  const std::vector<Interval>& B,
                                                  std::size_t columns) const {
  std::vector<Interval> result(n_ * columns);
  std::vector<double> middle(n_), c(n_), x(n_);
  for (std::size_t k = 0; k < columns; ++k) {
    for (std::size_t i = 0; i < n_; ++i) {
      middle[i] = 0.0;
      for (std::size_t j = 0; j < n_; ++j)
        middle[i] -= test.inverse(i, j) * mid(B[j * columns + k]);
    }
    if (!is_moderate(middle)) return {};
    std::vector<Interval> rest;
    for (std::size_t j = 0; j < n_; ++j) {
      Interval sum = B[j * columns + k];
      for (std::size_t l = 0; l < n_; ++l) sum = sum + middle[l] * test.derivative(j, l);
      rest.push_back(sum);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      Interval sum;
      for (std::size_t j = 0; j < n_; ++j) sum = sum + test.inverse(i, j) * rest[j];
      c[i] = mag(sum);
    }
    if (!is_moderate(c)) return {};
    domination.bound_solution(c.data(), x.data());
    if (!is_moderate(x)) return {};
    for (std::size_t i = 0; i < n_; ++i)
      result[i * columns + k] = point(middle[i]) + Interval{-x[i], x[i]};
  }
  return result;
}

/// |det(I + E)| is between the products of 1 ∓ (Pv)_i/v_i, and det(I + E) > 0.
Interval BranchQuantity::determinant(const BranchTest& test, const Domination& domination) const {
  const std::vector<double>& v = domination.v();
  Interval product = point(1.0);
  for (std::size_t i = 0; i < n_; ++i) {
    Interval sum;
    for (std::size_t j = 0; j < n_; ++j) sum = sum + P_[j * n_ + i] * point(v[j]);
    const Interval ratio = sum / point(v[i]);
    if (!is_bounded(ratio) || !(ratio.hi < 1.0)) return everything();
    product = product * Interval{down(1.0 - ratio.hi), up(1.0 + ratio.hi)};
  }
  std::vector<double> K;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) K.push_back(test.inverse(i, j));
  const Interval of_inverse = verifier::determinant(K, n_, kBitsOfQuantity).enclosure();
  return is_bounded(of_inverse) ? product / of_inverse : everything();
}

/// The largest sum of a row of |A·diag(factors)|, and of |(A·diag(factors))⁻¹|.
Interval BranchQuantity::condition(const BranchTest& test, const Domination& domination) const {
  std::vector<Interval> minus_unit(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i) minus_unit[i * n_ + i] = point(-1.0);
  const std::vector<Interval> inverse = derivatives(test, domination, minus_unit, n_);
  if (inverse.empty()) return everything();
  Interval of_matrix, of_inverse;
  for (std::size_t i = 0; i < n_; ++i) {
    Interval row, row_of_inverse;
    for (std::size_t j = 0; j < n_; ++j) {
      row = row + magnitude(test.derivative(i, j)) * factors_[j];
      row_of_inverse = row_of_inverse + magnitude(inverse[i * n_ + j]);
    }
    row_of_inverse = row_of_inverse / factors_[i];
    if (!is_bounded(row) || !is_bounded(row_of_inverse)) return everything();
    of_matrix = {std::max(of_matrix.lo, row.lo), std::max(of_matrix.hi, row.hi)};
    of_inverse = {std::max(of_inverse.lo, row_of_inverse.lo),
                  std::max(of_inverse.hi, row_of_inverse.hi)};
  }
  return of_matrix * of_inverse;
}

BranchQuantity::Work BranchQuantity::work(const std::vector<Interval>& along) const {
  Interval middle, spread;
  for (std::size_t i = 0; i < n_; ++i) {
    middle = middle + along[i] * middle_[i];
    spread = spread + magnitude(along[i]) * spread_[i];
  }
  for (const Ball& ball : balls_) {
    Interval squares;
    for (const std::size_t i : ball.members) squares = squares + square(along[i]);
    if (!is_bounded(squares)) return {everything(), everything()};
    spread = spread + ball.radius * sqrt(squares);
  }
  return {middle, spread};
}

/// The largest along·w over the load, with the sign of the side, or of its magnitude.
Interval BranchQuantity::of_load(const std::vector<Interval>& along) const {
  const auto [middle, spread] = work(along);
  if (!is_bounded(middle) || !is_bounded(spread)) return everything();
  return (quantity_.side == format::kAbsolute ? magnitude(middle)
          : quantity_.side == format::kLeast  ? -middle
                                              : middle) +
         spread;
}

/// The row of J diag(1/c) Jᵀ of the unknown.
std::vector<Interval> BranchQuantity::compliance(const std::vector<Interval>& J) const {
  const std::size_t own = quantity_.columns.front();
  std::vector<Interval> row(n_);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t k = 0; k < motors_; ++k) {
      const Interval a = J[own * motors_ + k], b = J[j * motors_ + k];
      row[j] = row[j] + (j == own ? square(a) : a * b) / of_motors_[k];
      if (!is_bounded(row[j])) return {};
    }
  return row;
}

/// Encloses J; empty: nothing is known.
std::vector<Interval> BranchQuantity::rates(const BranchTest& test, const Domination& domination) {
  if (!by_motor_.run(test.whole())) return {};
  std::vector<Interval> B;
  for (const NodeId node : quantity_.by_motor) B.push_back(by_motor_.value(node));
  return is_moderate(B) ? derivatives(test, domination, B, motors_) : std::vector<Interval>{};
}

/// The work of the load along each motor; empty: nothing is known.
std::vector<BranchQuantity::Work> BranchQuantity::forces(const BranchTest& test) {
  const auto domination = dominate(test);
  if (!domination) return {};
  const std::vector<Interval> J = rates(test, *domination);
  if (J.empty()) return {};
  std::vector<Work> all;
  std::vector<Interval> along(n_);
  for (std::size_t k = 0; k < motors_; ++k) {
    for (std::size_t i = 0; i < n_; ++i) along[i] = J[i * motors_ + k];
    all.push_back(work(along));
    if (!is_bounded(all.back().middle) || !is_bounded(all.back().spread)) return {};
  }
  return all;
}

Interval BranchQuantity::largest(const BranchTest& test) {
  if (quantity_.kind == format::kFiniteError) {
    const std::size_t own = quantity_.columns.front();
    return magnitude(test.difference(own, own + n_ / 2));
  }
  const auto domination = dominate(test);
  if (!domination) return everything();
  const std::string& kind = quantity_.kind;
  if (kind == format::kCondition) return condition(test, *domination);
  if (kind == format::kDeterminant || kind == format::kDeterminantMax) {
    const Interval det = determinant(test, *domination);
    if (!is_bounded(det)) return everything();
    if (kind == format::kDeterminant) return -magnitude(det);
    return quantity_.side == format::kAbsolute ? magnitude(det)
           : quantity_.side == format::kLeast  ? -det
                                               : det;
  }
  const std::vector<Interval> J = rates(test, *domination);
  if (J.empty()) return everything();
  std::vector<Interval> along(n_);
  if (kind == format::kForce) {
    for (std::size_t i = 0; i < n_; ++i) along[i] = J[i * motors_ + quantity_.row];
    return of_load(along);
  }
  if (kind == format::kDeflection) {
    along = compliance(J);
    return along.empty() ? everything() : of_load(along);
  }
  Interval sum;
  for (std::size_t k = 0; k < motors_; ++k)
    sum = sum + magnitude(J[quantity_.columns.front() * motors_ + k]) * of_motors_[k];
  return sum;
}

}  // namespace regulus::verifier
