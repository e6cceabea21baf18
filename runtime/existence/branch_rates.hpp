// SPDX-License-Identifier: Apache-2.0
// Bounds derivatives of a branch over a tube that has passed the test of branch_tube.hpp.
//
// KΦ_p = I + E with |E| ≤ P and Pr < r. So I − P has an inverse ≥ 0, and for a matrix B over the same
// box Z, with J = −Φ_p⁻¹B and any J₀,
//
//     (I + E)(J − J₀) = −(KB + KΦ_pJ₀),      |J − J₀| ≤ (I − P)⁻¹ |K(B + Φ_pJ₀)|.
//
// With B = Φ_q, J is the derivative of the branch by q; with B = −I it is Φ_p⁻¹. A column x of the bound
// comes from any g: if Pg + c − g ≤ β(r − Pr), then x = g + βr has Px + c ≤ x.
//
// With v > 0 and Pv < v, det(I + E) is that of diag(v)⁻¹(I + E)diag(v), whose diagonal dominates its
// rows: it is between Π(1 − (Pv)_i/v_i) and Π(1 + (Pv)_i/v_i), and positive.
#pragma once

#include <span>
#include <vector>

#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {

class BranchRates {
 public:
  /// `by_unknown`: encloses Φ_p over Z; n×n, row-major. The objects must outlive this one.
  ///
  /// Requires  has_one_solution(tube, image), for K = `inverse` and an enclosure over the same Z.
  BranchRates(const BranchTube& tube, const TubeImage& image, std::span<const double> inverse,
              std::span<const Interval> by_unknown)
      : tube_(tube),
        image_(image),
        inverse_(inverse),
        by_unknown_(by_unknown),
        n_(tube.radius.size()) {}

  /// Encloses −Φ_p⁻¹B over Z.
  ///
  /// Shape     B, the result: n×d, row-major.
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] std::vector<Interval> derivatives(std::span<const Interval> B, std::size_t d) const;
  /// Encloses Φ_p⁻¹ over Z.
  [[nodiscard]] std::vector<Interval> inverse() const;
  /// Encloses det Φ_p over Z; it has one sign. It may be unbounded.
  [[nodiscard]] Interval determinant() const;

 private:
  [[nodiscard]] double spread(std::size_t i, std::size_t j) const {
    return image_.spread[i * n_ + j];
  }
  void bound_solution(std::span<const double> c, std::span<double> x) const;

  const BranchTube& tube_;
  const TubeImage& image_;
  const std::span<const double> inverse_;
  const std::span<const Interval> by_unknown_;
  const std::size_t n_;
};

}  // namespace regulus::detail
