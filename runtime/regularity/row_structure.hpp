// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace regulus::detail {

/// The variables that touch one row only.
struct RowStructure {
  static constexpr int kWide = -1;
  std::vector<int> slot;          ///< for each variable: an index into rows, or kWide; or empty
  std::vector<std::size_t> rows;  ///< the rows touched
  /// For each variable: the number of the ball whose coordinate it is, or kNoBall; empty if there
  /// are none. The radius of such a variable is that of its ball.
  std::vector<int> ball = {};
  static constexpr int kNoBall = -1;

  /// Returns true if the variables have been analysed.
  [[nodiscard]] bool is_known() const noexcept { return !slot.empty(); }
  [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
  [[nodiscard]] bool touches_one_row(std::size_t variable) const noexcept {
    return !slot.empty() && slot[variable] != kWide;
  }
};

}  // namespace regulus::detail
