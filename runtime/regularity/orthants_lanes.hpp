// SPDX-License-Identifier: Apache-2.0
// The cells of orthants.hpp and parts of them, eight at a time.
//
// Rounding. c_kᵀm to nearest errs by at most γ|c_k|ᵀb, which is in `slack`; sums of magnitudes are
// raised. m = ±(a + b)/2 is within an ulp of b; r is increased by that.
#pragma once

#include "runtime/regularity/coupled_lanes.hpp"

namespace regulus::detail::orthants {
inline namespace REGULUS_LANES_ISA {

inline constexpr unsigned kMaxSteps = 16;

class Cells {
 public:
  /// Eight orthants; |ρ| is any vector up to ζ.
  REGULUS_LANE_INLINE Cells(const OrthantProblem& problem, unsigned first) noexcept
      : p_(problem), n_(problem.rows) {
    for (unsigned j = 0; j < n_; ++j) {
      high_[j] = Pack::of(p_.scale[j]);
      low_[j] = Pack::of(0.0);
      for (unsigned l = 0; l < kLanes; ++l) sign_[j].lane(l) = sign_in(first + l, j);
    }
  }
  REGULUS_LANE_INLINE Cells(const OrthantProblem& problem, const OrthantPart* parts) noexcept
      : p_(problem), n_(problem.rows) {
    for (unsigned j = 0; j < n_; ++j)
      for (unsigned l = 0; l < kLanes; ++l) {
        low_[j].lane(l) = parts[l].low[j];
        high_[j].lane(l) = parts[l].high[j];
        sign_[j].lane(l) = sign_in(parts[l].orthant, j);
      }
  }

  /// Finds, for each row, in which of eight orthants its |ρ_l| may be ζ_l.
  REGULUS_LANE_INLINE void possible(unsigned* lanes) noexcept {
    take_middle();
    for (unsigned l = 0; l < n_; ++l) lanes[l] = (kAllLanes) & ~less_lanes(bound(l), high_[l]);
  }

  /// Reduces eight parts to what may contain a ρ.
  REGULUS_LANE_INLINE void store(OrthantPart* parts) const noexcept {
    for (unsigned j = 0; j < n_; ++j)
      for (unsigned l = 0; l < kLanes; ++l) {
        parts[l].low[j] = low_[j].lane(l);
        parts[l].high[j] = high_[j].lane(l);
      }
  }

  /// Returns the parts that may contain a ρ, one bit each. What becomes of a part does not depend on
  /// the others.
  REGULUS_LANE_INLINE unsigned remaining() noexcept {
    unsigned alive = kAllLanes;
    active_ = kAllLanes;
    keep_active(alive);
    for (unsigned step = 0; step < kMaxSteps && active_ != 0; ++step) {
      take_middle();
      gained_ = 0;
      for (unsigned l = 0; l < n_; ++l) {
        f_[l] = bound(l);
        alive &= ~(less_lanes(f_[l], low_[l]) & active_);
      }
      keep_active(alive);
      if (active_ == 0) break;
      for (unsigned l = 0; l < n_; ++l) raise_lows(l);
      for (unsigned l = 0; l < n_; ++l) {
        note_gain(high_[l] - f_[l], l);
        high_[l] = if_active(smaller_of(high_[l], f_[l]), high_[l]);
        alive &= ~(less_lanes(high_[l], low_[l]) & active_);
      }
      keep_active(alive & gained_);
    }
    return alive;
  }

 private:
  static constexpr double kWorthwhile = 0x1p-8;  ///< of ζ

  /// Returns the sign of ρ_j; ρ₀ ≥ 0.
  REGULUS_LANE_INLINE static double sign_in(unsigned orthant, unsigned j) noexcept {
    return (orthant << 1 >> j & 1U) != 0 ? -1.0 : 1.0;
  }

  REGULUS_LANE_INLINE void note_gain(const Pack& change, unsigned j) noexcept {
    gained_ |= ~less_lanes(change, Pack::of(kWorthwhile * p_.scale[j]));
  }

  REGULUS_LANE_INLINE Pack if_active(const Pack& changed, const Pack& same) const noexcept {
    return select_less(Pack::of(0.0), is_active_, changed, same);
  }

  REGULUS_LANE_INLINE void keep_active(unsigned lanes) noexcept {
    active_ &= lanes;
    for (unsigned l = 0; l < kLanes; ++l) is_active_.lane(l) = (active_ >> l & 1U) != 0 ? 1.0 : 0.0;
  }

  REGULUS_LANE_INLINE void take_middle() noexcept {
    const Pack half = Pack::of(0.5);
    for (unsigned j = 0; j < n_; ++j) {
      from_[j] = low_[j];
      middle_[j] = sign_[j] * (half * low_[j] + half * high_[j]);
      radius_[j] = half * (high_[j] - low_[j]) + high_[j] * Pack::of(0x1p-50);
    }
    for (unsigned t = 0; t < p_.terms; ++t)
      for (unsigned k = p_.term[t].begin; k < p_.term[t].end; ++k) {
        Pack sum = Pack::of(0.0);
        for (unsigned j = 0; j < n_; ++j) sum.add_fused(Pack::of(p_.form[k * n_ + j]), middle_[j]);
        value_[k] = sum;
      }
  }

  /// Bounds one term of f_l from above, for the forms at the middle, plus −c_kj·change.
  REGULUS_LANE_INLINE Pack of_term(const OrthantProblem::Term& term, unsigned l, unsigned j,
                                   const Pack& change) const noexcept {
    using Kind = OrthantProblem::Term::Kind;
    const auto moved = [&](unsigned k) __attribute__((always_inline)) {
      Pack x = value_[term.begin + k];
      x.subtract_fused(Pack::of(p_.form[(term.begin + k) * n_ + j]), change);
      return x;
    };
    const unsigned count = term.end - term.begin;
    if (count == 1) return magnitude(moved(0)) * Pack::of(term.weight);
    if (term.kind == Kind::kNorm) {
      Pack squares = Pack::of(0.0);
      for (unsigned k = 0; k < count; ++k) {
        const Pack x = moved(k);
        squares.add_fused(x, x);
      }
      return raised(square_root(raised(squares, kFewTerms)), kFewTerms) * Pack::of(term.weight);
    }
    Pack x[kMaxCoupledForms];
    for (unsigned k = 0; k < count; ++k) x[k] = moved(k);
    if (term.kind == Kind::kRanges) return bound_ranges(x, term.first, term.second, sign_[l]);
    if (term.kind == Kind::kBalls) return bound_balls(x, term.first, term.second, sign_[l]);
    return raised(square_root(SpectralBound(x, 3, 3).largest), kFewTerms) * Pack::of(term.weight);
  }

  /// Bounds f_l over the cell from above.
  REGULUS_LANE_INLINE Pack bound(unsigned l) const noexcept {
    Pack sum = Pack::of(0.0);
    for (unsigned t = first(l); t < first(l + 1); ++t)
      sum = sum + of_term(p_.term[t], l, 0, Pack::of(0.0));
    for (unsigned j = 0; j < n_; ++j) {
      sum.add_fused(Pack::of(p_.reach[l * n_ + j]), radius_[j]);
      sum.add_fused(Pack::of(p_.slack[l * n_ + j]), high_[j]);
    }
    return raised(sum, kManyTerms);
  }

  /// Returns the same bound for |ρ_j| = from_[j].
  REGULUS_LANE_INLINE Pack bound_at_low(unsigned l, unsigned j) const noexcept {
    Pack sum = Pack::of(0.0);
    const Pack change = sign_[j] * (Pack::of(0.5) * (high_[j] - from_[j]));
    for (unsigned t = first(l); t < first(l + 1); ++t)
      sum = sum + of_term(p_.term[t], l, j, change);
    for (unsigned i = 0; i < n_; ++i) {
      const Pack radius = i == j ? high_[j] * Pack::of(0x1p-50) : radius_[i];
      sum.add_fused(Pack::of(p_.reach[l * n_ + i]), radius);
      sum.add_fused(Pack::of(p_.slack[l * n_ + i]), i == j ? from_[i] : high_[i]);
    }
    return raised(sum, kManyTerms);
  }

  /// Bounds bound_at_low from below, roughly: no term changes by more than its reach.
  REGULUS_LANE_INLINE Pack least_at_low(unsigned l, unsigned j) const noexcept {
    const double slope = p_.reach[l * n_ + j] + p_.slack[l * n_ + j];
    return f_[l] - Pack::of(slope) * (high_[j] - from_[j]);
  }

  REGULUS_LANE_INLINE void raise_lows(unsigned l) noexcept {
    if ((less_lanes(Pack::of(0.0), low_[l]) & active_) == 0) return;  // |ρ_l| may be anything
    for (unsigned j = 0; j < n_; ++j) {
      if (j == l) continue;
      const Pack least = least_at_low(l, j);
      if ((less_lanes(least, low_[l]) & active_) == 0) continue;
      const Pack at_low = select_less(least, low_[l], bound_at_low(l, j), f_[l]);
      if ((less_lanes(at_low, low_[l]) & active_) == 0) continue;
      // A part θ of the interval from there to high is excluded: the chord is below low_l.
      // Rounding: θ and the sum are lowered by more than their few roundings can have raised them.
      const Pack part = (low_[l] - at_low) / (f_[l] - at_low);
      const Pack usable =
          smaller_of(select_less(at_low, low_[l], part, Pack::of(0.0)), Pack::of(1.0));
      const Pack change = usable * (high_[j] - from_[j]) * Pack::of(1.0 - 0x1p-40);
      const Pack low = (from_[j] + change) * Pack::of(1.0 - 0x1p-50);
      note_gain(low - low_[j], j);
      low_[j] = if_active(select_less(low_[j], low, low, low_[j]), low_[j]);
    }
  }

  [[nodiscard]] REGULUS_LANE_INLINE unsigned first(unsigned row) const noexcept {
    return p_.first_term[row];
  }

  const OrthantProblem& p_;
  const unsigned n_;
  Pack low_[kMaxOrthantRows], high_[kMaxOrthantRows], sign_[kMaxOrthantRows];
  Pack from_[kMaxOrthantRows];  ///< low_ when the middle was taken
  Pack middle_[kMaxOrthantRows], radius_[kMaxOrthantRows], f_[kMaxOrthantRows];
  Pack value_[kMaxOrthantForms];
  unsigned active_ = 0;  ///< lanes that still change
  Pack is_active_;       ///< 1 or 0
  unsigned gained_ = 0;  ///< lanes that became worthwhile smaller in this step
};

inline void possible(const OrthantProblem& problem, unsigned first, unsigned* lanes) noexcept {
  Cells(problem, first).possible(lanes);
}

inline unsigned remaining(const OrthantProblem& problem, OrthantPart* parts) noexcept {
  Cells cells(problem, parts);
  const unsigned alive = cells.remaining();
  if (alive != 0) cells.store(parts);
  return alive;
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::orthants
