// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "codegen/question/condition/rotated_boxes.hpp"

namespace regulus::detail {

/// Bounds of the entries of B over a box, beside the middles and slopes of its diagonal
/// (condition_test.hpp).
struct EntryBounds {
  /// Rounding  outward; MXCSR at nearest.
  explicit EntryBounds(const RotatedBox& box);

  std::vector<double> off;                 ///< o_ij, row-major; 0 on the diagonal
  std::vector<double> error;               ///< e_i
  std::vector<std::vector<double>> parts;  ///< of both, by variable; roughly
};

}  // namespace regulus::detail
