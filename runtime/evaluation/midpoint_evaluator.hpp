// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/evaluation/box_lanes.hpp"

namespace regulus::detail {

/// Evaluates A at the midpoints of the boxes and inverts it: this is the preconditioner K.
class MidpointEvaluator {
 public:
  explicit MidpointEvaluator(const BoxLanes& lanes);

  void forget() noexcept { computed_.forget(); }

  /// Lanes in which A is defined at the midpoint.
  [[nodiscard]] LaneMask defined() noexcept;
  /// Lanes in which A is defined at the midpoint and K was found.
  [[nodiscard]] LaneMask preconditioned() noexcept;
  /// Returns K, n×m; 0 in lanes without K.
  [[nodiscard]] ConstPointMatrix preconditioner() noexcept;
  /// Lanes without K, or in which K·A is far from the identity even at the midpoint, so that tests
  /// on K·A fail for boxes of any size: A is too close to singular for K's digits.
  [[nodiscard]] LaneMask poorly_preconditioned() noexcept;
  [[nodiscard]] Interval preconditioner_determinant(std::size_t lane) noexcept;
  /// Returns det A, to nearest.
  [[nodiscard]] double approx_determinant(std::size_t lane) noexcept;

 private:
  void compute() noexcept;

  const BoxLanes& lanes_;
  const std::size_t rows_, columns_;
  AlignedBuffer matrix_, approx_matrix_, preconditioner_;
  Once computed_;
  LaneNumbers approx_determinant_{};
  LaneMask defined_ = 0, preconditioned_ = 0;
};

}  // namespace regulus::detail
