// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials in sines and cosines of joint angles, as polynomials in tangents of half the angles.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// The joint variables that are angles, each with the symbols that stand for its sine, its
/// cosine and t = tan(q/2).
class HalfAngles {
 public:
  explicit HalfAngles(const std::vector<PoseParameter>& pose);

  /// Returns the expression in the symbols of sines and cosines; nullopt for one that has other
  /// functions, or angles other than sums ± of joint angles.
  [[nodiscard]] std::optional<GiNaC::ex> polynomial(const GiNaC::ex& e) const;

  /// Returns a polynomial in sines and cosines with s² replaced by 1 − c².
  [[nodiscard]] GiNaC::ex without_squares(const GiNaC::ex& p) const;

  /// Divides p, without squares of sines, by the sines and cosines that every term has, and returns
  /// them as functions of the angles, each as often as it occurs.
  [[nodiscard]] std::vector<GiNaC::ex> take_common(GiNaC::ex& p) const;

  /// Returns a polynomial in the symbols of sines and cosines as a function of the angles.
  [[nodiscard]] GiNaC::ex in_angles(const GiNaC::ex& p) const;

  /// Returns the polynomial in t of which p is a quotient by powers of 1 + t².
  [[nodiscard]] GiNaC::ex numerator(const GiNaC::ex& p) const;

  /// Groups irreducible polynomials in t to such that are trigonometric polynomials; nullopt if that
  /// is not possible.
  [[nodiscard]] std::optional<std::vector<GiNaC::ex>> paired(std::vector<GiNaC::ex> factors) const;

  /// Returns the trigonometric polynomial, in the form with the fewer terms: of sines and cosines of
  /// single angles, or of sums of angles.
  [[nodiscard]] GiNaC::ex trigonometric(const GiNaC::ex& factor) const;

  /// Returns the indices in Model::pose of the joint variables that occur.
  [[nodiscard]] std::vector<std::size_t> joints_in(const GiNaC::ex& factor) const;

 private:
  struct Angle {
    std::size_t joint;
    GiNaC::ex q, sine, cosine, tangent;
  };

  std::vector<GiNaC::ex> joints_;
  std::vector<Angle> angles_;
};

}  // namespace regulus::detail
