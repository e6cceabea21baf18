// SPDX-License-Identifier: GPL-3.0-or-later
// The losses at a singular pose: the twists that the actuators do not control, and the rows of the
// full inverse Jacobian that depend on each other.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/analysis/null_vectors.hpp"
#include "codegen/question/engine/pipeline.hpp"

namespace regulus::detail {

/// The losses at one point. J⁻¹ is the full inverse Jacobian, including row scales. All values are
/// approximate.
struct Degeneracy {
  std::vector<double> singular_values;  ///< as in NullVectors
  /// v with J⁻¹·v ≈ 0. If the model names the components of a twist, with angular velocity 1 rad,
  /// or with velocity 1 for a translation; else with largest entry 1. The largest entry is
  /// positive.
  std::vector<std::vector<double>> twists;
  /// w with wᵀ·J⁻¹ ≈ 0 and largest entry 1: forces along the legs that are in equilibrium without a
  /// load.
  std::vector<std::vector<double>> rows;
};

/// A row with a smaller weight takes no part.
inline constexpr double kTakesPart = 1e-6;

/// Returns the numbers, from 1, of the rows that take part.
[[nodiscard]] std::vector<std::size_t> rows_taking_part(const Degeneracy& degeneracy);

/// Evaluates J⁻¹ of a formulation at points.
class InverseJacobian {
 public:
  explicit InverseJacobian(const PreparedSearch& preparation);

  /// Returns J⁻¹, row-major, at the middles of the ranges; nullopt if it is not defined there.
  [[nodiscard]] std::optional<std::vector<double>> approx_at(
      std::span<const Interval> variables) const;
  /// Returns the product of the lengths of the rows, without row scales if `scaled` is false, at
  /// the middles of the ranges. No determinant of rows of these lengths is larger (Hadamard), so it
  /// is the scale of one. nullopt if it is not defined there.
  [[nodiscard]] std::optional<double> approx_hadamard(std::span<const Interval> variables,
                                                      bool scaled) const;
  [[nodiscard]] std::optional<Degeneracy> approx_degeneracy(
      std::span<const Interval> variables) const;
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  /// Returns the operations of one evaluation.
  [[nodiscard]] std::size_t operations() const noexcept { return entries_.nodes.size(); }

 private:
  std::vector<TwistComponent> components_;
  std::size_t rows_, columns_;
  Program entries_;  ///< of A, and then the row scales
};

}  // namespace regulus::detail
