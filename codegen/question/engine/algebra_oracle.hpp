// SPDX-License-Identifier: GPL-3.0-or-later
// For singular points that are known exactly, and for models that are singular at every pose
// ("architecturally"): no search by bounds can show either.
#pragma once

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Multiplies the determinant out exactly, within a small budget. It tries this only if enclosures
/// of the determinant at sample points contain 0 to many bits.
///
/// It returns kVanishes if det A is the zero polynomial in the atoms of the entries: variables, and
/// functions of them as indeterminates, with sin²u + cos²u = 1 as the only relation. It returns
/// kSeemsToVanish if the enclosures at samples contain 0 to very many bits and the polynomial is
/// not 0, or too long.
///
/// Only the thread that made the preparation may use it.
class ExactAlgebra final : public AlgebraOracle {
 public:
  /// The preparation must outlive this object.
  explicit ExactAlgebra(const PreparedSearch& preparation) : preparation_(preparation) {}

  [[nodiscard]] Determinant determinant(std::span<const Interval> point) noexcept override;

  /// Puts the ends, as the model writes them, and the doubles in place of the variables. The
  /// determinant of what that leaves is expanded over the rationals; the roots and functions of
  /// numbers that remain are taken as indeterminates. Says nothing about ranges that `margin` has
  /// changed: the stages do not have their ends.
  [[nodiscard]] bool is_singular_at(std::span<const Interval> point,
                                    std::span<const PlaceInRange> places) noexcept override;

  /// See exact_place.hpp.
  [[nodiscard]] std::optional<ExactPlace> find_singular(
      std::span<const Interval> box) noexcept override;

  /// See enclosed_place.hpp.
  [[nodiscard]] std::optional<EnclosedPlace> enclose_singular(
      std::span<const Interval> box) noexcept override;

 private:
  const PreparedSearch& preparation_;
};

}  // namespace regulus::detail
