// SPDX-License-Identifier: GPL-3.0-or-later
// What a robot loses at a singular pose: the twists that its actuators do not notice, and the rows
// of the full inverse Jacobian that depend on each other.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/analysis/null_vectors.hpp"
#include "codegen/engine/pipeline.hpp"

namespace regulus::inline analysis {

/// At one point; J⁻¹ is the full inverse Jacobian, row scales included. Approximate throughout.
struct Degeneracy {
  std::vector<double> singular_values;  ///< as in NullVectors
  /// v with J⁻¹·v ≈ 0. Where the model names the components of a twist: of angular velocity 1 rad,
  /// or of velocity 1 for a translation; else of largest entry 1. The largest is positive.
  std::vector<std::vector<double>> twists;
  /// w with wᵀ·J⁻¹ ≈ 0, of largest entry 1: forces along the legs of a platform that are in
  /// equilibrium without a load.
  std::vector<std::vector<double>> rows;
};

/// A row whose weight is less takes no part.
inline constexpr double kTakesPart = 1e-6;

/// The numbers, from 1, of the rows that take part.
[[nodiscard]] std::vector<std::size_t> rows_taking_part(const Degeneracy& degeneracy);

/// J⁻¹ of a formulation, ready to be looked at in points.
class InverseJacobian {
 public:
  explicit InverseJacobian(const PreparedSearch& preparation);

  /// Row-major, at the middles of the ranges; nullopt where it is not defined.
  [[nodiscard]] std::optional<std::vector<double>> approx_at(
      std::span<const Interval> variables) const;
  [[nodiscard]] std::optional<Degeneracy> approx_degeneracy(
      std::span<const Interval> variables) const;
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  /// Of one evaluation.
  [[nodiscard]] std::size_t operations() const noexcept { return entries_.nodes.size(); }

 private:
  std::vector<TwistComponent> components_;
  std::size_t rows_, columns_;
  Program entries_;  ///< of A, and then the row scales
};

}  // namespace regulus::inline analysis
