// SPDX-License-Identifier: Apache-2.0
// Rounding. Signed sums are computed to nearest; each errs by at most γ times the sum of its terms'
// magnitudes (Higham, Accuracy and Stability of Numerical Algorithms, §3.1), where γ = 68·2^-50
// exceeds what 64 terms need by a factor of more than four, which covers the rounding of the
// magnitudes, too. Those are not summed one by one: over all pairs they factor, Σ_pq
// r_pr_q|D_p||D_q| = (Σ_p r_p|D_p|)². Sums of magnitudes become upper bounds by OctetMatrix::raise.
#include <algorithm>
#include <cmath>

#include "regulus/regularity/second_order.hpp"

namespace regulus {
namespace {

constexpr double kGamma = (64 + 4) * 0x1p-50;
static_assert(2 * kMaxRows + 1 < 64);

/// Of one sum of magnitudes at most; its price is 2^-35 of the sum.
constexpr std::size_t kTerms = std::size_t{1} << 16;

struct Middle {
  double middle, distance;  ///< distance: rounded once
};

Middle middle_of(const double* intervals, std::size_t at, std::size_t lane) noexcept {
  const double lo = intervals[lower_at(at, lane)], hi = intervals[upper_at(at, lane)];
  const double middle = 0.5 * lo + 0.5 * hi;
  return {middle, std::max(hi - middle, middle - lo)};
}

/// 0 instead of the middle.
Middle zero_of(const double* intervals, std::size_t at, std::size_t lane) noexcept {
  return {0.0, std::max(intervals[upper_at(at, lane)], -intervals[lower_at(at, lane)])};
}

double product_ru(double a, double b) noexcept { return raise_ru(a * b, raise_factor(1)); }

}  // namespace

void SecondOrderBounds::bound_ru(const SecondOrderInput& input, double* T) noexcept {
  read_center(input);
  add_second_order(input);
  bound_defect();
  weight_.clear();
  weight_of_g_.clear();
  rest_.clear();
  R_.clear();
  for (WideVariable& w : wide_) w.R.clear();
  for (const Group& group : groups_) bound_group(input, group);
  bound_rows();
  assemble(T);
}

/// K₀, e, D_p, Σ_p r_p|d_p|, and D_pK₀ to nearest.
void SecondOrderBounds::read_center(const SecondOrderInput& input) noexcept {
  for (std::size_t v = 0; v < radius_.size(); ++v)
    std::memcpy(radius_[v].value, input.radius + point_at(v, 0), sizeof(Octet));
  K_.load(input.K);
  abs_K_.load_magnitudes(K_);
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < columns_; ++j)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const std::size_t e = i * columns_ + j;
        const double one = i == j ? 1.0 : 0.0;
        e_(i, j)[l] = std::max(std::fabs(input.product[lower_at(e, l)] - one),
                               std::fabs(input.product[upper_at(e, l)] - one));
      }
  e_.raise(1);
  sum_d_.clear();
  sum_D_.clear();
  sum_DK_.clear();
  for (WideVariable& w : wide_) {
    const Octet& r = radius_[w.variable];
    w.D.clear();
    w.defect.clear();
    for (const Entry& e : w.first)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const Middle d = moves_ ? middle_of(input.first, e.at, l) : zero_of(input.first, e.at, l);
        w.D(e.row, e.column)[l] = d.middle;
        w.defect(e.row, e.column)[l] += d.distance * r[l];
      }
    sum_d_.add(w.defect);
    sum_D_.add_magnitudes(w.D, r);
    if (touched_.empty()) continue;
    w.DK.clear();
    w.DK.add_product(w.D, K_);
    sum_DK_.add_magnitudes(w.DK, r);
  }
  sum_d_.raise(kTerms);
  sum_D_.raise(kTerms);
  sum_DK_.raise(kTerms);
}

void SecondOrderBounds::add_second_order(const SecondOrderInput& input) noexcept {
  radius_of_B_.clear();
  magnitude_of_B_.clear();
  for (const Pair& pair : pairs_) add_pair(input, pair);
  radius_of_B_.raise(kTerms);
  magnitude_of_B_.raise(kTerms);
  P_.clear();
  for (const WideVariable& w : wide_) P_.add(w.defect);
}

/// r_pr_q·|B_pq − D_pD_q − D_qD_p|, or r_p²·|½B_pp − D_pD_p|: half of it on account of p, half of
/// q.
void SecondOrderBounds::add_pair(const SecondOrderInput& input, const Pair& pair) noexcept {
  WideVariable &p = wide_[pair.p], &q = wide_[pair.q];
  const bool square = pair.p == pair.q;
  const double share = square ? 0.5 : 1.0;
  Octet half;
  for (std::size_t l = 0; l < kLanes; ++l)
    half[l] = 0.5 * product_ru(radius_[p.variable][l], radius_[q.variable][l]);
  pair_.clear();
  for (const Entry& e : pair.second)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Middle b = middle_of(input.second, e.at, l);
      const double weight = 2.0 * half[l] * share;
      const double radius = product_ru(raise_ru(b.distance, raise_factor(1)), weight);
      pair_(e.row, e.column)[l] = -b.middle * share;
      radius_of_B_(e.row, e.column)[l] += radius;
      magnitude_of_B_(e.row, e.column)[l] += std::fabs(b.middle) * weight + radius;
      p.defect(e.row, e.column)[l] += 0.5 * radius;
      q.defect(e.row, e.column)[l] += 0.5 * radius;
    }
  pair_.add_product(p.D, q.D);
  if (!square) pair_.add_product(q.D, p.D);
  p.defect.add_magnitudes(pair_, half);
  q.defect.add_magnitudes(pair_, half);
}

/// P ≥ |E|: what read_center and add_pair found (Σr|d| and the radii of B_pq among it), plus
///
///     e + Σr|D|·(e + Σr|d| + ½Σrr|B|) + γ(Σr|D|·Σr|D| + ½Σrr|B|).
void SecondOrderBounds::bound_defect() noexcept {
  OctetMatrix& sum = pair_;  // free by now
  sum.clear();
  sum.add(e_);
  P_.add(sum);
  sum.add(sum_d_);
  sum.add(magnitude_of_B_);
  sum.raise(3);
  P_.add_product(sum_D_, sum);
  sum.clear();
  sum.add_product(sum_D_, sum_D_);
  sum.add(magnitude_of_B_);
  sum.raise(kTerms);
  sum.scale(kGamma);
  P_.add(sum);
  P_.raise(kTerms);
}

/// Sums |x|, or for the members of a ball x²: |Σ_k δ_kx_k| ≤ ρ·(Σ_k x_k²)^½ when ‖δ‖ ≤ ρ.
void SecondOrderBounds::accumulate(Octet& sum, const Octet& x, bool ball) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) sum[l] += ball ? x[l] * x[l] : std::fabs(x[l]);
}

/// Σ|x| or (Σx²)^½, from above, of what was accumulated.
void SecondOrderBounds::finish(OctetMatrix& sums, bool ball) noexcept {
  sums.raise(kMaxBall);
  if (!ball) return;
  sums.root();
  sums.raise(1);
}

/// Adds what one uncertain quantity, or the coordinates of a point in a ball, contribute to R, to
/// the weights of Q and to the rest of their row. The bounds of a ball hold for the weights and for
/// what rounding adds, too, by Minkowski's inequality.
void SecondOrderBounds::bound_group(const SecondOrderInput& input, const Group& group) noexcept {
  const bool ball = group.size() > 1;
  const std::size_t slot = row_variables_[group.front()].slot;
  Octet range = radius_[row_variables_[group.front()].variable];
  columns_of_group_.clear();
  R_of_group_.clear();
  for (const std::size_t k : group) {
    RowVariable& u = row_variables_[k];
    for (std::size_t l = 0; l < kLanes; ++l) range[l] = std::max(range[l], radius_[u.variable][l]);
    read_row_variable(input, u);
    // |w̄_kᵀK₀| and |(g_kpᵀ − w̄_kᵀD_p)K₀| at the rows touched; |w̄_k| and |g_kp|.
    for (const Entry& e : u.first)
      accumulate(columns_of_group_(0, e.column), row_(0, e.column), ball);
    for (std::size_t p = 0; p < wide_.size(); ++p)
      for (const Entry& e : u.mixed[p])
        accumulate(columns_of_group_(1 + p, e.column), slope_(p, e.column), ball);
    for (std::size_t s = 0; s < touched_.size(); ++s) {
      const std::size_t r = touched_[s];
      Octet fixed{};
      for (const Entry& e : u.first) add_product(fixed, row_(0, e.column), K_(e.column, r));
      accumulate(R_of_group_(0, s), fixed, ball);
      for (std::size_t p = 0; p < wide_.size(); ++p) {
        Octet moving{};
        for (const Entry& e : u.mixed[p]) add_product(moving, slope_(p, e.column), K_(e.column, r));
        for (const Entry& e : u.first)
          subtract_product(moving, row_(0, e.column), wide_[p].DK(e.column, r));
        accumulate(R_of_group_(1 + p, s), moving, ball);
      }
    }
  }
  finish(columns_of_group_, ball);
  finish(R_of_group_, ball);
  add_group(slot, range, ball ? nullptr : &row_variables_[group.front()]);
}

/// w̄_k and g_kp; what is left of the row goes into the rest.
void SecondOrderBounds::read_row_variable(const SecondOrderInput& input,
                                          const RowVariable& u) noexcept {
  const Octet& range = radius_[u.variable];
  row_.clear();
  slope_.clear();
  for (const Entry& e : u.first)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Middle w = middle_of(input.row_first, e.at, l);
      row_(0, e.column)[l] = w.middle;
      rest_(u.slot, e.column)[l] += w.distance * range[l];
    }
  for (std::size_t p = 0; p < wide_.size(); ++p)
    for (const Entry& e : u.mixed[p])
      for (std::size_t l = 0; l < kLanes; ++l) {
        const Middle g =
            moves_ ? middle_of(input.row_second, e.at, l) : zero_of(input.row_second, e.at, l);
        slope_(p, e.column)[l] = g.middle;
        rest_(u.slot, e.column)[l] +=
            g.distance * product_ru(radius_[wide_[p].variable][l], range[l]);
      }
  for (const auto& [other, entries] : u.same_row)
    for (const Entry& e : entries)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double magnitude = std::max(std::fabs(input.row_second[lower_at(e.at, l)]),
                                          std::fabs(input.row_second[upper_at(e.at, l)]));
        rest_(u.slot, e.column)[l] += magnitude * product_ru(radius_[other][l], range[l]);
      }
}

void SecondOrderBounds::add_group(std::size_t slot, const Octet& range,
                                  RowVariable* single) noexcept {
  for (std::size_t j = 0; j < columns_; ++j)
    add_product(weight_(slot, j), columns_of_group_(0, j), range);
  if (single != nullptr) single->R.clear();
  for (std::size_t p = 0; p <= wide_.size(); ++p) {
    Octet weight = range;  // Δ, then r_pΔ
    if (p > 0)
      for (std::size_t l = 0; l < kLanes; ++l)
        weight[l] = product_ru(radius_[wide_[p - 1].variable][l], range[l]);
    for (std::size_t j = 0; p > 0 && j < columns_; ++j)
      add_product(weight_of_g_(slot, j), columns_of_group_(p, j), weight);
    for (std::size_t s = 0; s < touched_.size(); ++s) {
      add_product(R_(slot, s), R_of_group_(p, s), weight);
      if (single != nullptr) add_product(single->R(0, s), R_of_group_(p, s), weight);
      if (p > 0) add_product(wide_[p - 1].R(slot, s), R_of_group_(p, s), weight);
    }
  }
}

/// The second order and the rounding of R and of D_pK₀: |fl(D_pK₀) − D_pK₀| ≤ γ|D_p||K₀|.
void SecondOrderBounds::bound_rows() noexcept {
  if (touched_.empty()) return;
  weight_.raise(kTerms);
  weight_of_g_.raise(kTerms);
  rest_.raise(kTerms);
  // Σ_p r_p|D_pK₀|, with its rounding.
  OctetMatrix& slack = K_;  // not needed any more
  slack.clear();
  slack.add_product(sum_D_, abs_K_);
  slack.raise(kTerms);
  slack.scale(kGamma);
  sum_DK_.add(slack);
  sum_DK_.raise(2);
  slack.scale(1.0 / kGamma);
  slack.add(abs_K_);
  slack.raise(4);  // ≥ |K₀| + Σ_p r_p|D_p||K₀|
  for (std::size_t s = 0; s < touched_.size(); ++s)
    for (std::size_t j = 0; j < touched_.size(); ++j) {
      Octet second{}, magnitude{};
      for (std::size_t i = 0; i < columns_; ++i) {
        const std::size_t r = touched_[j];
        add_product(second, weight_of_g_(s, i), sum_DK_(i, r));
        add_product(magnitude, weight_of_g_(s, i), slack(i, r));
        add_product(magnitude, weight_(s, i), slack(i, r));
      }
      add(R_(s, j), second);
      for (std::size_t l = 0; l < kLanes; ++l)
        R_(s, j)[l] += raise_ru(magnitude[l], raise_factor(kTerms)) * (2.0 * kGamma);
    }
  R_.raise(kTerms);
}

void SecondOrderBounds::assemble(double* T) const noexcept {
  const std::size_t n = columns_, N = order();
  const auto set = [&](std::size_t i, std::size_t j, const Octet& x) {
    std::memcpy(T + point_at(i * N + j, 0), x.value, sizeof(Octet));
  };
  const auto raised = [](Octet x, std::size_t terms) {
    for (std::size_t l = 0; l < kLanes; ++l) x[l] = raise_ru(x[l], raise_factor(terms));
    return x;
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) set(i, j, P_(i, j));
    for (std::size_t s = 0; s < touched_.size(); ++s) {
      Octet x = abs_K_(i, touched_[s]);
      add(x, sum_DK_(i, touched_[s]));
      set(i, n + s, raised(x, 2));
    }
  }
  for (std::size_t s = 0; s < touched_.size(); ++s) {
    for (std::size_t j = 0; j < n; ++j) {
      Octet x = rest_(s, j);
      for (std::size_t i = 0; i < n; ++i) {
        add_product(x, weight_(s, i), P_(i, j));
        add_product(x, weight_of_g_(s, i), P_(i, j));
      }
      set(n + s, j, raised(x, kTerms));
    }
    for (std::size_t j = 0; j < touched_.size(); ++j) set(n + s, n + j, R_(s, j));
  }
}

}  // namespace regulus
