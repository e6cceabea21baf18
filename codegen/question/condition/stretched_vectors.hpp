// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors that show how large or small singular values of a matrix are. Any two vectors u ≠ 0 and v ≠ 0
// show σ_max ≥ |Au|/|u| and σ_min ≤ |Av|/|v|, and so κ ≥ |Au|·|v|/(|Av|·|u|) if Av ≠ 0.
#pragma once

#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Vectors that show a condition number.
struct StretchedVectors {
  double condition = 1;             ///< κ ≥ condition; infinite: A is singular
  std::vector<double> most, least;  ///< u and v
};

/// Shape     A row-major; encloses a matrix.
/// Rounding  `condition` down; MXCSR at nearest.
[[nodiscard]] StretchedVectors attained_condition(std::span<const Interval> A, std::size_t rows,
                                                  std::size_t columns);

/// A vector shows these bounds of the extreme singular values.
struct AttainedValues {
  double largest = 0;        ///< σ_max is at least that
  double least = kInfinity;  ///< σ_min is at most that
};

/// Shape     A row-major; encloses a matrix.
/// Rounding  `largest` down, `least` up; MXCSR at nearest.
[[nodiscard]] AttainedValues attained_values(std::span<const Interval> A, std::size_t rows,
                                             std::size_t columns);

}  // namespace regulus::detail
