// SPDX-License-Identifier: Apache-2.0
// The cells of orthants.hpp, eight at a time.
//
// Rounding. c_kᵀm to nearest errs by at most γ|c_k|ᵀb, which `slack` has; sums of magnitudes are
// raised. m = ±(a + b)/2 is within an ulp of b, for which r is enlarged.
#pragma once

#include "regulus/regularity/octet_lanes.hpp"
#include "regulus/regularity/orthants.hpp"

namespace regulus::orthants {
inline namespace REGULUS_LANES_ISA {

using namespace octet::REGULUS_LANES_ISA;

inline constexpr double kFewTerms = raise_factor(16);
inline constexpr double kManyTerms = raise_factor(std::size_t{1} << 16);
inline constexpr unsigned kMaxSteps = 16;

class Cells {
 public:
  /// Eight orthants; |ρ| is anything up to ζ.
  REGULUS_OCTET Cells(const OrthantProblem& problem, unsigned first) noexcept
      : p_(problem), n_(problem.rows) {
    for (unsigned j = 0; j < n_; ++j) {
      high_[j] = Octet::of(p_.scale[j]);
      low_[j] = Octet::of(0.0);
      for (unsigned l = 0; l < kOctet; ++l) sign_[j].lane(l) = sign_in(first + l, j);
    }
  }
  /// Of these, the cells listed: |ρ_l| = ζ_l for the row that is fixed.
  REGULUS_OCTET Cells(const OrthantProblem& problem, const OrthantCell* cells) noexcept
      : p_(problem), n_(problem.rows) {
    for (unsigned j = 0; j < n_; ++j) {
      high_[j] = Octet::of(p_.scale[j]);
      for (unsigned l = 0; l < kOctet; ++l) {
        low_[j].lane(l) = cells[l].fixed == j ? p_.scale[j] : 0.0;
        sign_[j].lane(l) = sign_in(cells[l].orthant, j);
      }
    }
  }

  /// For each row, in which of eight orthants its |ρ_l| may be ζ_l.
  REGULUS_OCTET void possible(unsigned* lanes) noexcept {
    take_middle();
    for (unsigned l = 0; l < n_; ++l)
      lanes[l] = ((1U << kOctet) - 1) & ~less_lanes(bound(l), high_[l]);
  }

  /// The cells that may hold a ρ, one bit each.
  REGULUS_OCTET unsigned remaining() noexcept {
    unsigned alive = (1U << kOctet) - 1;
    for (unsigned step = 0; step < kMaxSteps; ++step) {
      take_middle();
      double gain = 0.0;
      for (unsigned l = 0; l < n_; ++l) {
        f_[l] = bound(l);
        alive &= ~less_lanes(f_[l], low_[l]);
      }
      if (alive == 0) return 0;
      for (unsigned l = 0; l < n_; ++l) raise_lows(l, alive, gain);
      for (unsigned l = 0; l < n_; ++l) {
        gain = larger_gain(gain, high_[l] - f_[l], l, alive);
        high_[l] = smaller_of(high_[l], f_[l]);
      }
      if (gain < kWorthwhile) break;
    }
    return alive;
  }

 private:
  static constexpr double kWorthwhile = 0x1p-8;  ///< of ζ

  /// That of ρ_j; ρ₀ ≥ 0.
  REGULUS_OCTET static double sign_in(unsigned orthant, unsigned j) noexcept {
    return (orthant << 1 >> j & 1U) != 0 ? -1.0 : 1.0;
  }

  REGULUS_OCTET static Octet smaller_of(const Octet& a, const Octet& b) noexcept {
    return select_less(b, a, b, a);
  }

  REGULUS_OCTET double larger_gain(double gain, const Octet& change, unsigned j,
                                   unsigned alive) const noexcept {
    for (unsigned l = 0; l < kOctet; ++l)
      if ((alive >> l & 1U) != 0 && change.lane(l) > gain * p_.scale[j])
        gain = change.lane(l) / p_.scale[j];
    return gain;
  }

  REGULUS_OCTET void take_middle() noexcept {
    const Octet half = Octet::of(0.5);
    for (unsigned j = 0; j < n_; ++j) {
      from_[j] = low_[j];
      middle_[j] = sign_[j] * (half * low_[j] + half * high_[j]);
      radius_[j] = half * (high_[j] - low_[j]) + high_[j] * Octet::of(0x1p-50);
    }
    for (unsigned t = 0; t < p_.terms; ++t)
      for (unsigned k = p_.term[t].begin; k < p_.term[t].end; ++k) {
        Octet sum = Octet::of(0.0);
        for (unsigned j = 0; j < n_; ++j) sum.add_fused(Octet::of(p_.form[k * n_ + j]), middle_[j]);
        value_[k] = sum;
      }
  }

  /// Δ|x| or ρ‖x‖ of one term, from above; x: the forms at the middle, moved by −c_kj·change.
  REGULUS_OCTET Octet of_term(const OrthantProblem::Term& term, unsigned j,
                              const Octet& change) const noexcept {
    const auto moved = [&](unsigned k) __attribute__((always_inline)) {
      Octet x = value_[k];
      x.subtract_fused(Octet::of(p_.form[k * n_ + j]), change);
      return x;
    };
    if (term.end - term.begin == 1) return magnitude(moved(term.begin)) * Octet::of(term.weight);
    Octet squares = Octet::of(0.0);
    for (unsigned k = term.begin; k < term.end; ++k) {
      const Octet x = moved(k);
      squares.add_fused(x, x);
    }
    return raised(square_root(raised(squares, kFewTerms)), kFewTerms) * Octet::of(term.weight);
  }

  /// f_l over the cell from above.
  REGULUS_OCTET Octet bound(unsigned l) const noexcept {
    Octet sum = Octet::of(0.0);
    for (unsigned t = first(l); t < first(l + 1); ++t)
      sum = sum + of_term(p_.term[t], 0, Octet::of(0.0));
    for (unsigned j = 0; j < n_; ++j) {
      sum.add_fused(Octet::of(p_.reach[l * n_ + j]), radius_[j]);
      sum.add_fused(Octet::of(p_.slack[l * n_ + j]), high_[j]);
    }
    return raised(sum, kManyTerms);
  }

  /// The same where |ρ_j| = from_[j].
  REGULUS_OCTET Octet bound_at_low(unsigned l, unsigned j) const noexcept {
    Octet sum = Octet::of(0.0);
    const Octet change = sign_[j] * (Octet::of(0.5) * (high_[j] - from_[j]));
    for (unsigned t = first(l); t < first(l + 1); ++t) sum = sum + of_term(p_.term[t], j, change);
    for (unsigned i = 0; i < n_; ++i) {
      const Octet radius = i == j ? high_[j] * Octet::of(0x1p-50) : radius_[i];
      sum.add_fused(Octet::of(p_.reach[l * n_ + i]), radius);
      sum.add_fused(Octet::of(p_.slack[l * n_ + i]), i == j ? from_[i] : high_[i]);
    }
    return raised(sum, kManyTerms);
  }

  REGULUS_OCTET void raise_lows(unsigned l, unsigned alive, double& gain) noexcept {
    if ((less_lanes(Octet::of(0.0), low_[l]) & alive) == 0) return;  // |ρ_l| may be anything
    for (unsigned j = 0; j < n_; ++j) {
      if (j == l) continue;
      const Octet at_low = bound_at_low(l, j);
      if ((less_lanes(at_low, low_[l]) & alive) == 0) continue;
      // A part θ of the way from there to high is excluded: the chord is below low_l. Rounding: θ
      // and the sum are lowered by more than their few roundings can have raised them.
      const Octet part = (low_[l] - at_low) / (f_[l] - at_low);
      const Octet usable =
          smaller_of(select_less(at_low, low_[l], part, Octet::of(0.0)), Octet::of(1.0));
      const Octet change = usable * (high_[j] - from_[j]) * Octet::of(1.0 - 0x1p-40);
      const Octet low = (from_[j] + change) * Octet::of(1.0 - 0x1p-50);
      gain = larger_gain(gain, low - low_[j], j, alive);
      low_[j] = select_less(low_[j], low, low, low_[j]);
    }
  }

  [[nodiscard]] REGULUS_OCTET unsigned first(unsigned row) const noexcept {
    return p_.first_term[row];
  }

  const OrthantProblem& p_;
  const unsigned n_;
  Octet low_[kMaxOrthantRows], high_[kMaxOrthantRows], sign_[kMaxOrthantRows];
  Octet from_[kMaxOrthantRows];  ///< low_ when the middle was taken
  Octet middle_[kMaxOrthantRows], radius_[kMaxOrthantRows], f_[kMaxOrthantRows];
  Octet value_[kMaxOrthantForms];
};

inline void possible(const OrthantProblem& problem, unsigned first, unsigned* lanes) noexcept {
  Cells(problem, first).possible(lanes);
}

inline unsigned remaining(const OrthantProblem& problem, const OrthantCell* cells) noexcept {
  return Cells(problem, cells).remaining();
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::orthants
