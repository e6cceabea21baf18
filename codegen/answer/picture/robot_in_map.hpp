// SPDX-License-Identifier: GPL-3.0-or-later
// The robot over a map, where the map shows the place of one of its points: its base, platform and
// legs, of a robot in space as seen along the third axis. For drawing only.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "codegen/answer/picture/picture_options.hpp"
#include "codegen/answer/picture/plot.hpp"
#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Throws UsageError, with what helps, unless the model has points to draw, and the two parameters
/// along the axes are coordinates of one of them, or of the origin of the platform's frame.
void require_robot_in_map(const Request& request, const SearchSubject& subject,
                          const PictureOptions& options);

/// The robot at the middle of all ranges, with a slice at its value, and a larger dot at the place
/// that the map is about. Requires require_robot_in_map().
class RobotInMap {
 public:
  RobotInMap(const PreparedSearch& preparation, const PictureOptions& options);

  /// Returns the range along the axis, 0 across and 1 up, with the robot of every slice.
  [[nodiscard]] const Interval& extent(std::size_t axis) const { return extent_[axis]; }
  void add_to(Plot& plot, const std::optional<Slice>& slice, bool has_legend) const;

 private:
  struct Path {
    PathStyle style;
    std::vector<PlacePoint> points;
  };
  [[nodiscard]] std::vector<Path> paths_at(const std::optional<Slice>& slice) const;
  void include_paths();

  const PreparedSearch& preparation_;
  const PictureOptions& options_;
  std::array<std::size_t, 2> coordinates_{};  ///< of points: across, up
  std::array<Interval, 2> extent_{};
};

}  // namespace regulus::detail
