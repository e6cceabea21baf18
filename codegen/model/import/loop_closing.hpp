// SPDX-License-Identifier: GPL-3.0-or-later
// Closes loops by Newton's method, in doubles, and chooses their equations.
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/model/import/loop_gap.hpp"

namespace regulus::detail {

/// Loops, and the values of their joints' variables.
struct LoopPose {
  const std::vector<CutLoop>& loops;
  const std::vector<LoopJoint>& joints;
  std::vector<double> values;  ///< by variable

  [[nodiscard]] std::vector<double> gap() const;             ///< of all loops, one after another
  [[nodiscard]] double gap_of_loop(std::size_t loop) const;  ///< by how much it is open
  [[nodiscard]] double largest_gap() const;
  /// Derivatives of the gap; row-major, parts of the gap × `by`.
  [[nodiscard]] std::vector<double> slopes(const std::vector<std::size_t>& by) const;
};

/// Moves these variables until the loops are closed, or no step makes their gaps smaller.
void close_loops(LoopPose& pose, const std::vector<std::size_t>& moving);

/// Parts of the gap whose derivatives by some variables are independent, at one pose.
struct IndependentRows {
  std::vector<std::size_t> rows;     ///< parts of the gap of all loops
  std::vector<std::size_t> columns;  ///< of `by`, that they determine
  std::vector<std::size_t> by_loop;  ///< how many of each loop
};

/// Chooses as many as there are, and of each loop at most `most`; parts that are `idle` are not chosen.
[[nodiscard]] IndependentRows independent_rows(const LoopPose& pose,
                                               const std::vector<std::size_t>& by,
                                               const std::vector<std::size_t>& most,
                                               const std::vector<char>& idle);

}  // namespace regulus::detail
