// SPDX-License-Identifier: GPL-3.0-or-later
// Follows the configuration of a closure from its start to other places, approximately. Nothing
// rests on it but which tubes are tried.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/closure/closed_system.hpp"

namespace regulus::detail {

/// A place and a configuration, or nearly one.
struct BranchPoint {
  std::vector<double> variables;  ///< motion parameters and uncertain quantities
  std::vector<double> unknowns;
};

/// A place, the configuration there, and what the equations say of it.
struct TrackedPoint {
  BranchPoint at;
  std::vector<double> inverse;  ///< of Φ_p, n×n
  std::vector<double> slopes;   ///< S = −Φ_p⁻¹Φ_x, n×m
};

/// Follows the configuration from `start` along a line to each of 1…8 places, by Newton's method
/// with steps that halve where it converges badly, or where a step passes no solutions; nullopt where it
/// loses its way. The result for a place depends on that place alone.
///
/// Rounding  none: approximate; MXCSR at nearest.
[[nodiscard]] std::vector<std::optional<TrackedPoint>> track(
    SystemBoxes& system, const ClosedShape& shape, const BranchPoint& start,
    std::span<const std::vector<double>> places);

/// Follows it to one place, and returns the last configuration before it lost its way, with the part
/// of the line that was followed; nullopt if it did not begin.
struct LostWay {
  double part = 0;  ///< 1: it was not lost
  TrackedPoint last;
};
[[nodiscard]] std::optional<LostWay> track_until_lost(SystemBoxes& system, const ClosedShape& shape,
                                                      const BranchPoint& start,
                                                      const std::vector<double>& place);

/// The same from a start of its own for each place, without a way: Newton's method there.
[[nodiscard]] std::vector<std::optional<TrackedPoint>> settle(SystemBoxes& system,
                                                              const ClosedShape& shape,
                                                              std::span<const BranchPoint> near);

}  // namespace regulus::detail
