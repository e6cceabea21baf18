// SPDX-License-Identifier: Apache-2.0
// Bounds of the coupled terms of orthants.hpp, eight at a time. They get x, y and Z one after the
// other, Z row-major, and Z̃ = −σZ.
//
// Ranges. max over |s_i| ≤ 1, |t_j| ≤ 1 of sᵀx + tᵀy + tᵀZ̃s = max over s_i = ±1 of sᵀx + |y + Z̃s|₁.
//
// Balls. With h = Z̃ᵀy, q ≥ ‖y‖² + ‖Z‖₂² and any c > 0, for ‖s‖ ≤ 1,
//
//     ‖y + Z̃s‖ ≤ ½(c‖y + Z̃s‖² + 1/c) ≤ ½c(q + 2hᵀs) + 1/(2c),
//
// so the maximum is at most ‖x + ch‖ + ½cq + 1/(2c), and also at most ‖x‖ + ‖y‖ + ‖Z‖₂. The first
// is stationary in c at c = (q + 2hᵀ(x + ch)/‖x + ch‖)^(−½); one step to there is enough.
//
// ‖Z‖₂² is the largest eigenvalue of G = ZᵀZ, n×n of mean eigenvalue m = tr G/n: at most m +
// ((n − 1)/n·(‖G‖_F² − nm²))^½, as the eigenvalues have that mean and the variance ‖G‖_F²/n − m².
//
// Rounding. A form of orthants.hpp errs by less than γ|c|ᵀb, and sums of fewer than 64 such numbers,
// of any sign, by less than that once more; both are in `slack`.
#pragma once

#include "runtime/regularity/orthants.hpp"
#include "runtime/regularity/pack_lanes.hpp"

namespace regulus::detail::orthants {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

inline constexpr double kFewTerms = raise_factor(16);
inline constexpr double kManyTerms = raise_factor(std::size_t{1} << 16);

/// Returns a, if b is NaN.
REGULUS_LANE_INLINE Pack smaller_of(const Pack& a, const Pack& b) noexcept {
  return select_less(b, a, b, a);
}

/// Bounds the Euclidean norm of `count` numbers from above.
REGULUS_LANE_INLINE Pack norm_of(const Pack* x, unsigned count) noexcept {
  Pack squares = Pack::of(0.0);
  for (unsigned k = 0; k < count; ++k) squares.add_fused(x[k], x[k]);
  return raised(square_root(raised(squares, kFewTerms)), kFewTerms);
}

/// Bounds tr ZᵀZ, and the largest eigenvalue of ZᵀZ, from above; Z: `rows` × `columns` ≤ 3 × 3. An
/// entry of G errs by a few ulps of tr G, so ‖G‖_F² − nm² errs by far less than 2^-44 (tr G)².
struct SpectralBound {
  Pack trace, largest;

  REGULUS_LANE_INLINE SpectralBound(const Pack* Z, unsigned rows, unsigned columns) noexcept {
    trace = Pack::of(0.0);
    Pack squares = Pack::of(0.0);
    for (unsigned a = 0; a < columns; ++a)
      for (unsigned b = 0; b <= a; ++b) {
        Pack entry = Pack::of(0.0);
        for (unsigned row = 0; row < rows; ++row)
          entry.add_fused(Z[columns * row + a], Z[columns * row + b]);
        if (a == b) trace = trace + entry;
        squares.add_fused(a == b ? entry : entry + entry, entry);
      }
    const double n = columns;
    const Pack mean = trace * Pack::of(1.0 / n), spread = squares - mean * trace;
    const Pack variance = select_less(Pack::of(0.0), spread, spread, Pack::of(0.0)) +
                          trace * trace * Pack::of(0x1p-44);
    const Pack deviation = square_root(raised(variance * Pack::of((n - 1.0) / n), kFewTerms));
    largest = raised(mean + deviation, kFewTerms);
    trace = raised(trace, kFewTerms);
  }
};

/// The maximum over ends of `first` ranges: each step changes the end of one of them, in the order
/// of a Gray code.
REGULUS_LANE_INLINE Pack bound_ranges(const Pack* x, unsigned first, unsigned second,
                                      const Pack& sign) noexcept {
  const Pack* const y = x + first;
  const Pack* const Z = y + second;
  Pack sum = Pack::of(0.0), at_end[kMaxCoupled], twice[kMaxCoupled * kMaxEndsTried];
  bool is_upper[kMaxEndsTried] = {};
  for (unsigned i = 0; i < first; ++i) sum = sum - x[i];
  for (unsigned j = 0; j < second; ++j) {
    at_end[j] = y[j];
    for (unsigned i = 0; i < first; ++i) {
      const Pack z = sign * Z[j * first + i];
      at_end[j] = at_end[j] + z;  // Z̃ = −σZ, s = −1
      twice[j * first + i] = z + z;
    }
  }
  Pack result = Pack::of(0.0);
  for (unsigned step = 1;; ++step) {
    Pack value = sum;
    for (unsigned j = 0; j < second; ++j) value = value + magnitude(at_end[j]);
    result = larger(value, result);
    if (step == 1U << first) return result;
    const auto i = static_cast<unsigned>(__builtin_ctz(step));
    is_upper[i] = !is_upper[i];
    const Pack change = x[i] + x[i];
    sum = is_upper[i] ? sum + change : sum - change;
    for (unsigned j = 0; j < second; ++j) {
      const Pack& z = twice[j * first + i];
      at_end[j] = is_upper[i] ? at_end[j] - z : at_end[j] + z;
    }
  }
}

/// Computes x + ch of two balls, and bounds its norm.
struct ShiftedNorm {
  Pack x[kMaxOfBall] = {}, norm = {};

  REGULUS_LANE_INLINE ShiftedNorm(const Pack* x0, const Pack* h, const Pack& c,
                                  unsigned count) noexcept {
    for (unsigned i = 0; i < count; ++i) {
      x[i] = x0[i];
      x[i].add_fused(c, h[i]);
    }
    norm = norm_of(x, count);
  }
};

/// c need not be exact, except that the bound uses one value of it. Cancellation in x + ch costs at
/// most 2^-44 times what is cancelled.
REGULUS_LANE_INLINE Pack bound_balls(const Pack* x, unsigned first, unsigned second,
                                     const Pack& sign) noexcept {
  const Pack* const y = x + first;
  const Pack* const Z = y + second;
  const SpectralBound spectral(Z, second, first);
  const Pack norm_x = norm_of(x, first), norm_y = norm_of(y, second);
  const Pack norm_Z = raised(square_root(spectral.largest), kFewTerms);
  const Pack apart = raised(norm_x + norm_y + norm_Z, kFewTerms);
  Pack h[kMaxOfBall] = {};
  for (unsigned i = 0; i < first; ++i) {
    Pack sum = Pack::of(0.0);
    for (unsigned j = 0; j < second; ++j) sum.subtract_fused(Z[j * first + i], y[j]);
    h[i] = sign * sum;
  }
  const Pack one = Pack::of(1.0), half = Pack::of(0.5);
  const Pack q = raised(norm_y * norm_y + spectral.largest, kFewTerms);
  const ShiftedNorm guess(x, h, one / square_root(q), first);
  Pack along = Pack::of(0.0);
  for (unsigned i = 0; i < first; ++i) along.add_fused(h[i], guess.x[i]);
  const Pack c = one / square_root(q + Pack::of(2.0) * along / guess.norm);
  const ShiftedNorm shifted(x, h, c, first);
  const Pack cancelled = norm_x + c * square_root(spectral.trace) * norm_y;
  const Pack together = shifted.norm + half * c * q + half / c + Pack::of(0x1p-44) * cancelled;
  return smaller_of(apart, raised(together, kFewTerms));
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::orthants
