// SPDX-License-Identifier: GPL-3.0-or-later
// Products UᵀSV of an interval matrix with two matrices of doubles.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/condition/singular_vectors.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Matrices, row-major: every entry is within `error` of `middle`. Entries that are not finite mean
/// that nothing is known.
struct RoundMatrix {
  std::vector<double> middle, error;
};

/// Says how a rotation changes singular values, for every A and B = UᵀAV; infinite if U or V is far from
/// orthogonal. With |UᵀU − I| ≤ ε and |VᵀV − I| ≤ ε', |U|² ≤ 1 + ε and |U⁻¹|² ≤ 1/(1 − ε), and the same
/// of V.
struct Distortion {
  double ratio = kInfinity;    ///< κ(A) ≤ ratio·κ(B)
  double largest = kInfinity;  ///< σ_max(A) ≤ largest·σ_max(B)
  double least = kInfinity;    ///< σ_min(B) ≤ least·σ_min(A)
};

class Rotation {
 public:
  /// Shape     left: rows × rows, right: columns × columns, at most 64 rows.
  Rotation(const SingularVectors& vectors, std::size_t rows, std::size_t columns);

  /// Encloses UᵀSV for all S within the bounds.
  ///
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] RoundMatrix apply(std::span<const Interval> S) const;

  /// Encloses SV, for a matrix S = Uᵀ…, in the same way.
  [[nodiscard]] RoundMatrix apply_right(std::span<const Interval> S) const;

  [[nodiscard]] Distortion distortion() const;

 private:
  /// Returns UᵀSV to nearest, or with the magnitudes of U and V. A zero row of S costs little.
  [[nodiscard]] std::vector<double> product(const std::vector<double>& U,
                                            const std::vector<double>& S,
                                            const std::vector<double>& V) const;

  /// Splits S into its middles and bounds of what is beside them, errors of rounding included.
  void split(std::span<const Interval> S, std::vector<double>& middle,
             std::vector<double>& radius) const;

  const std::size_t m_, n_;
  const std::vector<double>&U_, &V_;
  std::vector<double> size_of_U_, size_of_V_;
};

/// A bound of a sum of at most 4096 products of nonnegative doubles that was computed to nearest.
[[nodiscard]] inline double enlarged(double sum) noexcept { return sum * (1 + 0x1p-40) + 1e-300; }

}  // namespace regulus::detail
