// SPDX-License-Identifier: GPL-3.0-or-later
// Singular values of A = Φ_p·C over a tube, C the factors of the columns, to the first order.
//
// A tube has x = x₀ + δ and p = c + Sδ + ρ with |δ_k| ≤ r_k and |ρ| ≤ r. Let Z be the box of
// branch_tube.hpp, which contains the tube over the hull of its places and x₀. The segment from (x₀, c) to
// (x, p) is in Z, so that
//
//     A(x, p) ∈ A(x₀, c) + Σ_k (∂_kA + Σ_l S_lk·∂_lA)(Z)·δ_k + Σ_l ∂_lA(Z)·ρ_l.
//
// These are slopes by δ and ρ, for the bounds of condition_test.hpp and singular_value_test.hpp.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/closure/tube_judge.hpp"
#include "codegen/question/quantity/quantity_kind.hpp"

namespace regulus::detail {

/// Bounds f over a tube; f is κ, σ_max or −σ_min.
struct SingularValueFinding {
  double upper = kInfinity;      ///< f is at most that at every configuration
  std::vector<double> impact{};  ///< by variable: roughly what it adds to the excess; may be empty
  std::vector<double> growth{};  ///< by variable: roughly the slope of log |f|; may be empty
};

class SingularValues {
 public:
  /// True for the condition number in the 2-norm, and for the largest and the least singular value.
  [[nodiscard]] static bool are_of(QuantityKind kind);

  /// `factors`: of the columns, positive.
  ///
  /// Requires  are_of(kind).
  SingularValues(QuantityKind kind, std::vector<Interval> factors)
      : kind_(kind), factors_(std::move(factors)) {}

  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] SingularValueFinding bound(const TubeTrial& tube,
                                           const TubeFinder::Measured& measured) const;
  /// Returns a number that f is at least, at every configuration of the tube; −∞ if nothing is known.
  [[nodiscard]] double attained(const TubeFinder::Measured& measured) const;

 private:
  [[nodiscard]] std::vector<Interval> scaled(std::span<const Interval> by_unknown) const;
  [[nodiscard]] BoxMatrix matrix_over(const TubeTrial& tube,
                                      const TubeFinder::Measured& measured) const;

  const QuantityKind kind_;
  const std::vector<Interval> factors_;
};

}  // namespace regulus::detail
