// SPDX-License-Identifier: Apache-2.0
// Letters as in PROOF.md: K, E, P, w_k, T, and v for the positive vector with Tv < v.
#include "regulus/certificate/verifier/regularity.hpp"

#include <algorithm>
#include <cmath>

#include "regulus/certificate/verifier/derivative.hpp"
#include "regulus/certificate/verifier/elementary.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBits = 64;
constexpr std::size_t kMostWork = 1 << 24;  ///< numbers that a box may take
constexpr int kSweeps = 40;                 ///< of the power iteration

/// Below this part of 1 the ranges of wide variables are not what keeps a box open.
constexpr double kNoImpact = 0.02;

constexpr double kNarrowest = 0x1p-44;  ///< of a range, relative to the variety's

constexpr std::size_t kUntouched = std::size_t(-1);
constexpr std::size_t kSeveral = std::size_t(-2);

/// The row of A that depends on a variable.
std::size_t row_touched(const Question& q, const Dependence& dependence, std::size_t variable) {
  std::size_t row = kUntouched;
  for (std::size_t e = 0; e < q.matrix.size(); ++e) {
    if (!dependence.on(q.matrix[e], variable)) continue;
    const std::size_t i = e / q.columns;
    row = row == kUntouched || row == i ? i : kSeveral;
  }
  return row;
}

int ball_of(const Question& q, std::size_t variable) {
  for (std::size_t b = 0; b < q.balls.size(); ++b)
    for (const std::size_t member : q.balls[b].members)
      if (member == variable) return int(b);
  return -1;
}

/// S that makes the entries of S⁻¹XS alike: √(right/left Perron vector of X), roughly.
std::vector<double> balance(const std::vector<double>& X, std::size_t n) {
  std::vector<double> right(n, 1.0), left(n, 1.0), result;
  for (int step = 0; step < 10; ++step) {
    std::vector<double> to_right(n, 1e-300), to_left(n, 1e-300);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        to_right[i] += X[i * n + j] * right[j];
        to_left[j] += X[i * n + j] * left[i];
      }
    right = to_right;
    left = to_left;
  }
  for (std::size_t i = 0; i < n; ++i)
    result.push_back(std::clamp(std::sqrt(right[i] / left[i]), 1e-100, 1e100));
  return result;
}

}  // namespace

RegularityTest::RegularityTest(Question& question, const Variety& variety)
    : q_(question), variety_(variety), in_group_(question.variables.size()) {
  find_structure();
  form_terms();
  form_directions();
  make_evaluations();
  const std::size_t n = q_.columns, order = n + rows_.size(), wide = wide_.size();
  radius_.resize(q_.variables.size());
  for (Matrix* matrix : {&e_, &X_, &Z_}) matrix->resize(n * n);
  KC_.assign(terms_.size(), IntervalMatrix(n * n));
  B_.assign(wide, IntervalMatrix(n * n));
  D_.assign(wide, Matrix(n * n));
  share_ = D_;
  DK_.assign(wide, IntervalMatrix(n * rows_.size()));
  pair_.resize(n * n);
  of_quantity_.resize(q_.variables.size());
  T_ = {order, Matrix(order * order)};
  for (std::vector<double>* vector : {&v_, &Tv_, &quantity_, &group_sum_}) vector->resize(order);
  for (std::vector<double>* vector : {&w_, &moving_}) vector->resize(n);
  g_.resize(n);
  moved_.resize(n * rows_.size());
}

/// Motion parameters are wide even where they touch one row: they are what is split.
void RegularityTest::find_structure() {
  const Dependence dependence(q_.graph, q_.variables.size());
  for (std::size_t k = 0; k < q_.variables.size(); ++k) {
    const std::size_t row = row_touched(q_, dependence, k);
    if (row == kUntouched) continue;
    if (row == kSeveral || q_.variables[k].kind == VariableKind::kParameter)
      wide_.push_back(k);
    else
      add_quantity(k, row);
  }
}

void RegularityTest::add_quantity(std::size_t variable, std::size_t row) {
  in_group_[variable] = true;
  directions_[variable].row = row;
  const auto slot = std::size_t(std::find(rows_.begin(), rows_.end(), row) - rows_.begin());
  if (slot == rows_.size()) rows_.push_back(row);
  const int ball = ball_of(q_, variable);
  const auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
    return ball >= 0 && g.ball == ball && g.slot == slot;
  });
  if (same != groups_.end())
    same->members.push_back(variable);
  else
    groups_.push_back({slot, ball, {variable}});
}

void RegularityTest::form_terms() {
  for (Term& term : expand(q_.graph, q_.matrix, wide_, q_.variables.size()))
    terms_.push_back({std::move(term), {}, {}});
  const std::size_t pairs = wide_.size() * (wide_.size() + 1) / 2;
  if (terms_.size() * (pairs + q_.columns * q_.columns) > kMostWork)
    throw Unfinished("the matrix has too many terms in too many variables");
  std::vector<Differentiator> by;
  for (const std::size_t p : wide_) by.emplace_back(q_.graph, p);
  for (WideTerm& t : terms_)
    for (std::size_t p = 0; p < wide_.size(); ++p) {
      t.first.push_back(by[p].of(t.term.monomial));
      for (std::size_t q = 0; q <= p; ++q)
        t.second.push_back(t.first[p] == kNoNode ? kNoNode : by[q].of(t.first[p]));
    }
}

void RegularityTest::form_directions() {
  std::map<std::size_t, Differentiator> by;
  for (const auto& [k, direction] : directions_) by.try_emplace(k, q_.graph, k);
  for (const std::size_t p : wide_) by.try_emplace(p, q_.graph, p);
  const auto derivatives = [&](std::size_t variable, const std::vector<NodeId>& nodes) {
    std::vector<NodeId> result;
    for (const NodeId node : nodes)
      result.push_back(node == kNoNode ? kNoNode : by.at(variable).of(node));
    return result;
  };
  for (auto& [k, d] : directions_) {
    const auto row = q_.matrix.begin() + std::ptrdiff_t(d.row * q_.columns);
    d.w = derivatives(k, {row, row + std::ptrdiff_t(q_.columns)});
    for (const std::size_t p : wide_) d.by_wide.push_back(derivatives(p, d.w));
    for (const auto& [other, same] : directions_)
      if (same.row == d.row) d.by_quantity.emplace_back(other, derivatives(other, d.w));
  }
}

void RegularityTest::make_evaluations() {
  std::vector<NodeId> middle = q_.matrix, wide, all = q_.matrix;
  const auto append = [](std::vector<NodeId>& to, const std::vector<NodeId>& nodes) {
    to.insert(to.end(), nodes.begin(), nodes.end());
  };
  for (const WideTerm& t : terms_) {
    middle.push_back(t.term.monomial);
    append(middle, t.first);
    append(wide, t.second);
    for (const Coefficient& c : t.term.coefficients) middle.push_back(c.node);
  }
  for (const auto& [k, d] : directions_) {
    append(middle, d.w);
    for (const auto& nodes : d.by_wide) append(all, nodes);
    for (const auto& [other, nodes] : d.by_quantity) append(all, nodes);
  }
  append(all, q_.defined);
  append(all, q_.motion_defined);
  if (q_.has_threshold) append(all, q_.scale);
  std::vector<NodeId> motion = q_.motion_defined;
  append(motion, q_.constraints);
  at_middle_.emplace(q_.graph, middle);
  over_wide_.emplace(q_.graph, wide);
  over_all_.emplace(q_.graph, all);
  motion_.emplace(q_.graph, motion);
}

RegularityTest::Answer RegularityTest::decide(const Box& box) {
  evaluated_ = false;
  place_middle(box);
  if (is_outside(box)) return Answer::kOutside;
  if (!evaluate_all(box)) return Answer::kOpen;
  bound_product();
  bound_rows(box);
  evaluated_ = true;
  return find_vector() && exceeds_threshold() ? Answer::kRegular : Answer::kOpen;
}

bool RegularityTest::is_outside(const Box& box) {
  for (std::size_t b = 0; b < q_.balls.size(); ++b)
    if (is_beyond(q_.balls[b], variety_.reach[b], box)) return true;
  if (q_.constraints.empty() || !motion_->run(box)) return false;
  return std::any_of(q_.constraints.begin(), q_.constraints.end(),
                     [this](NodeId h) { return motion_->value(h).lo > 0.0; });
}

/// Every point of the box is farther than `reach` from the middle of the ball.
bool RegularityTest::is_beyond(const BallOfVariables& ball, double reach, const Box& box) const {
  Interval distance;
  for (const std::size_t k : ball.members)
    distance = distance + square(box[k] - point(mid(variety_.outer[k])));
  return sqrt(distance).lo > reach;
}

/// A double of each range; all of a range that no double is certainly in.
void RegularityTest::place_middle(const Box& box) {
  middle_ = pose_box_ = box;
  for (std::size_t k = 0; k < box.size(); ++k) {
    if (variety_.inner[k]) middle_[k] = point(mid(box[k]));
    radius_[k] = variety_.inner[k] ? radius_ru(box[k], middle_[k].lo) : 0.0;
    if (in_group_[k]) pose_box_[k] = middle_[k];
  }
}

/// Also makes K.
bool RegularityTest::evaluate_all(const Box& box) {
  if (!at_middle_->run(middle_) || !over_all_->run(box) || !over_wide_->run(pose_box_))
    return false;
  std::vector<double> A;
  for (const NodeId node : q_.matrix) A.push_back(mid(at_middle_->value(node)));
  return approx_left_inverse(A, q_.rows, q_.columns, K_);
}

/// P bounds E(t) = K(t)A − I, K(t) = (I − Στ_pD_p)K, by Taylor's theorem for B = K·A.
void RegularityTest::bound_product() {
  const std::size_t n = q_.columns;
  for (std::size_t t = 0; t < terms_.size(); ++t) multiply_term(t);
  add_terms(pair_, [this](const WideTerm& t) { return at_middle_->value(t.term.monomial); });
  for (std::size_t i = 0; i < n; ++i) pair_[i * n + i] = pair_[i * n + i] - point(1.0);
  for (std::size_t e = 0; e < n * n; ++e) e_[e] = mag(pair_[e]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) T_.at(i, j) = e_[i * n + j];
  for (Matrix* matrix : {&X_, &Z_}) std::fill(matrix->begin(), matrix->end(), 0.0);
  for (std::size_t p = 0; p < wide_.size(); ++p) add_slope(p);
  for (std::size_t p = 0, pair = 0; p < wide_.size(); ++p)
    for (std::size_t q = 0; q <= p; ++q) add_pair(p, q, pair++);
  // X|e| and XZ.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        T_.at(i, j) = up(T_.at(i, j) + up(X_[i * n + k] * up(e_[k * n + j] + Z_[k * n + j])));
}

/// K·C_μ.
void RegularityTest::multiply_term(std::size_t t) {
  const std::size_t n = q_.columns;
  std::fill(KC_[t].begin(), KC_[t].end(), Interval{});
  for (const Coefficient& c : terms_[t].term.coefficients) {
    const Interval value = at_middle_->value(c.node);
    if (is_zero(value)) continue;
    const std::size_t l = c.entry / n, j = c.entry % n;
    for (std::size_t i = 0; i < n; ++i)
      KC_[t][i * n + j] = KC_[t][i * n + j] + K_[i * q_.rows + l] * value;
  }
}

/// Σ_μ K·C_μ·value(μ).
template <class Value>
void RegularityTest::add_terms(IntervalMatrix& sum, Value value) const {
  std::fill(sum.begin(), sum.end(), Interval{});
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const Interval x = value(terms_[t]);
    if (is_zero(x)) continue;
    for (std::size_t e = 0; e < sum.size(); ++e) sum[e] = sum[e] + KC_[t][e] * x;
  }
}

/// B_p at the middle, D_p in it, r_p|B_p − D_p| and D_p·K.
void RegularityTest::add_slope(std::size_t p) {
  const std::size_t n = q_.columns, slots = rows_.size();
  add_terms(B_[p], [&](const WideTerm& t) { return at_middle_->value(t.first[p]); });
  const double r = radius_[wide_[p]];
  Matrix& D = D_[p];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t e = i * n + j;
      D[e] = mid(B_[p][e]);
      T_.at(i, j) = up(T_.at(i, j) + up(r * radius_ru(B_[p][e], D[e])));
      X_[e] = up(X_[e] + up(r * std::fabs(D[e])));
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t s = 0; s < slots; ++s) {
      Interval sum;
      for (std::size_t j = 0; j < n; ++j)
        sum = sum + D[i * n + j] * point(K_[j * q_.rows + rows_[s]]);
      DK_[p][i * slots + s] = sum;
    }
  std::fill(share_[p].begin(), share_[p].end(), 0.0);
}

/// r_pr_q|B_pq − D_pB_q − D_qB_p|, half of it where p = q; and Z.
void RegularityTest::add_pair(std::size_t p, std::size_t q, std::size_t pair) {
  const std::size_t n = q_.columns;
  add_terms(pair_, [&](const WideTerm& t) { return over_wide_->value(t.second[pair]); });
  const double r = up(radius_[wide_[p]] * radius_[wide_[q]]) * (p == q ? 0.5 : 1.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Interval sum = pair_[i * n + j];
      Z_[i * n + j] = up(Z_[i * n + j] + up(r * mag(sum)));
      for (std::size_t k = 0; k < n; ++k)
        sum = sum - D_[p][i * n + k] * B_[q][k * n + j] - D_[q][i * n + k] * B_[p][k * n + j];
      const double bound = up(r * mag(sum));
      T_.at(i, j) = up(T_.at(i, j) + bound);
      share_[p][i * n + j] += bound;
      share_[q][i * n + j] += bound;
    }
}

bool RegularityTest::is_whole(const Group& group, const Box& box) const {
  return std::all_of(group.members.begin(), group.members.end(), [&](std::size_t k) {
    return box[k].lo == variety_.outer[k].lo && box[k].hi == variety_.outer[k].hi;
  });
}

/// The columns and rows of T that belong to the rows of A touched by groups.
void RegularityTest::bound_rows(const Box& box) {
  const std::size_t n = q_.columns, order = T_.order, slots = rows_.size();
  for (std::size_t s = 0; s < slots; ++s) {
    for (std::size_t i = 0; i < n; ++i) {
      double& moved = moved_[i * slots + s] = 0.0;
      for (std::size_t p = 0; p < wide_.size(); ++p)
        moved = up(moved + up(radius_[wide_[p]] * mag(DK_[p][i * slots + s])));
      T_.at(i, n + s) = up(std::fabs(K_[i * q_.rows + rows_[s]]) + moved);
    }
    for (std::size_t j = 0; j < order; ++j) T_.at(n + s, j) = 0.0;
  }
  for (const Group& group : groups_) {
    // A ball that has been split is bounded by the box around what is left of it.
    const bool as_ball = group.ball >= 0 && is_whole(group, box);
    std::fill(group_sum_.begin(), group_sum_.end(), 0.0);
    for (const std::size_t k : group.members) {
      bound_quantity(k);
      of_quantity_[k] = quantity_;
      for (std::size_t j = 0; j < order; ++j) {
        const double x = quantity_[j];
        group_sum_[j] = up(group_sum_[j] + up(as_ball ? x * x : radius_[k] * x));
      }
    }
    for (std::size_t j = 0; j < order; ++j) {
      const double sum =
          as_ball ? up(variety_.reach[std::size_t(group.ball)] * up(std::sqrt(group_sum_[j])))
                  : group_sum_[j];
      T_.at(n + group.slot, j) = up(T_.at(n + group.slot, j) + sum);
    }
  }
}

/// quantity_: |w(t)|ᵀP + |w − w(t)|ᵀ and, for each slot, |w(t)ᵀK(t)e_l|, where w(t) = w̄ + Στ_pg_p
/// follows w, the derivative of the row by the quantity.
void RegularityTest::bound_quantity(std::size_t variable) {
  const Direction& d = directions_.at(variable);
  const std::size_t n = q_.columns, slots = rows_.size();
  std::fill(quantity_.begin(), quantity_.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const Interval w = at_middle_->value(d.w[j]);
    w_[j] = mid(w);
    quantity_[j] = radius_ru(w, w_[j]);
    moving_[j] = 0.0;
    for (const auto& [other, nodes] : d.by_quantity)
      quantity_[j] = up(quantity_[j] + up(radius_[other] * mag(over_all_->value(nodes[j]))));
  }
  for (std::size_t s = 0; s < slots; ++s) {
    Interval sum;
    for (std::size_t i = 0; i < n; ++i) sum = sum + w_[i] * point(K_[i * q_.rows + rows_[s]]);
    quantity_[n + s] = mag(sum);
  }
  for (std::size_t p = 0; p < wide_.size(); ++p) follow(d, p);
  for (std::size_t i = 0; i < n; ++i) {
    const double bound_of_w = up(std::fabs(w_[i]) + moving_[i]);
    for (std::size_t j = 0; j < n; ++j)
      quantity_[j] = up(quantity_[j] + up(bound_of_w * T_.at(i, j)));
    // Στ_pτ_q g_pᵀD_qK: |K(t)| − |K| is Σr_q|D_qK|.
    for (std::size_t s = 0; s < slots; ++s)
      quantity_[n + s] = up(quantity_[n + s] + up(moving_[i] * moved_[i * slots + s]));
  }
}

/// What wide variable p adds to |w − w(t)| and, to first order, to |w(t)ᵀK(t)|.
void RegularityTest::follow(const Direction& d, std::size_t p) {
  const std::size_t n = q_.columns, slots = rows_.size();
  const double r = radius_[wide_[p]];
  for (std::size_t j = 0; j < n; ++j) {
    const Interval g = over_all_->value(d.by_wide[p][j]);
    g_[j] = mid(g);
    quantity_[j] = up(quantity_[j] + up(r * radius_ru(g, g_[j])));
    moving_[j] = up(moving_[j] + up(r * std::fabs(g_[j])));
  }
  for (std::size_t s = 0; s < slots; ++s) {
    Interval sum;
    for (std::size_t i = 0; i < n; ++i)
      sum = sum + g_[i] * point(K_[i * q_.rows + rows_[s]]) - w_[i] * DK_[p][i * slots + s];
    quantity_[n + s] = up(quantity_[n + s] + up(r * mag(sum)));
  }
}

/// Tv < v, rounded upward. False where any bound is NaN or infinite.
bool RegularityTest::dominates() const {
  for (std::size_t i = 0; i < T_.order; ++i)
    if (!(Tv_[i] < v_[i]) || !(v_[i] < kInfinity)) return false;
  return true;
}

/// Power iteration; the sum of old and new vector keeps it from going round in circles.
bool RegularityTest::find_vector() {
  std::fill(v_.begin(), v_.end(), 1.0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < T_.order; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < T_.order; ++j) sum = up(sum + up(T_.at(i, j) * v_[j]));
      Tv_[i] = sum;
    }
    if (dominates()) return true;
    double largest = 0.0;
    for (std::size_t i = 0; i < T_.order; ++i) largest = std::max(largest, v_[i] + Tv_[i]);
    if (!(largest < kInfinity)) return false;
    for (std::size_t i = 0; i < T_.order; ++i)
      v_[i] = std::max((v_[i] + Tv_[i]) / largest, 0x1p-200);
  }
  return false;
}

/// Encloses 1/|det K(t)/det K| over the box from below: |ln|det(I + X)| − tr X| ≤ f²/(2 − 2f) where
/// the Frobenius norm of X is at most f < 1, as |tr Xʲ| ≤ fʲ. Determinant and trace are those of
/// S⁻¹XS, too, for any positive diagonal S.
Interval RegularityTest::moving_determinant() const {
  const std::size_t n = q_.columns;
  const std::vector<double> scale = balance(X_, n);
  Interval norm, exponent;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      norm = norm + square(X_[i * n + j] * point(scale[j]) / point(scale[i]));
  const double f = sqrt(norm).hi;
  if (!(f < 1.0)) return {};
  for (std::size_t p = 0; p < wide_.size(); ++p) {
    Interval trace;
    for (std::size_t i = 0; i < n; ++i) trace = trace + point(D_[p][i * n + i]);
    exponent = exponent + point(radius_[wide_[p]]) * point(mag(trace));
  }
  exponent = exponent + square(point(f)) / (2.0 * (point(1.0) - point(f)));
  return apply(Op::kExp, -exponent);
}

/// |det J⁻¹| ≥ det(I − T)·∏|scale|/|det K(t)| > α: I − T is an M-matrix, since Tv < v.
bool RegularityTest::exceeds_threshold() const {
  if (!q_.has_threshold) return true;
  std::vector<Ball> comparison;
  for (std::size_t i = 0; i < T_.order; ++i)
    for (std::size_t j = 0; j < T_.order; ++j)
      comparison.emplace_back(point(i == j ? 1.0 : 0.0) - point(T_.at(i, j)), kBits);
  Interval bound = determinant(comparison, T_.order, kBits).enclosure();
  if (!(bound.lo > 0.0)) return false;
  for (const NodeId scale : q_.scale) bound = bound * point(mig(over_all_->value(scale)));
  bound = bound / point(mag(determinant(K_, q_.columns, kBits).enclosure()));
  bound = bound * point(mig(moving_determinant()));
  return is_bounded(bound) && bound.lo > variety_.alpha.hi;
}

/// Roughly what each variable adds to keep T from having Tv < v. Where only the threshold is
/// missing, what moves the determinant counts.
std::vector<double> RegularityTest::impacts() const {
  std::vector<double> impact(q_.variables.size(), 0.0);
  const std::size_t n = q_.columns;
  const bool is_regular = dominates();
  double of_wide = 0.0;
  for (std::size_t p = 0; p < wide_.size(); ++p) {
    double& sum = impact[wide_[p]];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double first = radius_[wide_[p]] * std::fabs(D_[p][i * n + j]);
        sum += (is_regular ? first : share_[p][i * n + j]) * v_[j] / v_[i];
      }
    of_wide += sum;
  }
  if (!is_regular && of_wide > kNoImpact) return impact;
  for (const Group& group : groups_)
    for (const std::size_t k : group.members)
      for (std::size_t j = 0; j < T_.order; ++j)
        impact[k] += radius_[k] * of_quantity_[k][j] * v_[j] / v_[n + group.slot];
  return impact;
}

std::optional<std::size_t> RegularityTest::variable_to_split(const Box& box) const {
  const std::vector<double> impact = evaluated_ ? impacts() : std::vector<double>(box.size(), 0.0);
  const bool has_impact = *std::max_element(impact.begin(), impact.end()) > 0.0;
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t k = 0; k < box.size(); ++k) {
    const Interval x = box[k], root = variety_.outer[k];
    const double middle = mid(x), width = (x.hi - x.lo) / (root.hi - root.lo);
    if (!(x.lo < middle && middle < x.hi && width > kNarrowest)) continue;
    const double score = has_impact ? impact[k] : width;
    if (score > most) best = k, most = score;
  }
  return best;
}

int RegularityTest::sign_at_middle() const {
  if (!evaluated_ || q_.rows != q_.columns) return 0;
  const std::size_t n = q_.columns;
  // |K·A − I| < 1 in the row-sum norm joins K·A to I by regular matrices: det K·A > 0.
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j) sum = up(sum + e_[i * n + j]);
    if (!(sum < 1.0)) return 0;
  }
  const Ball det = determinant(K_, n, 128);
  return arb_is_positive(det.get()) ? 1 : arb_is_negative(det.get()) ? -1 : 0;
}

}  // namespace regulus::verifier
