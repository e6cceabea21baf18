// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// The balls in which uncertain points of the robot lie, as far as a problem gives them for certain.
///
/// A problem has a cube inside each ball. A singularity may be outside the cube, up to √3 times as
/// far from the middle.
class ToleranceBalls {
 public:
  struct Ball {
    std::vector<std::size_t> members;  ///< the variables that are the point's coordinates
    std::vector<Interval> center;      ///< encloses the ball's middle, member by member
    double radius = 0;                 ///< of the ball, at most
  };

  /// Ensures   each point within `radius` of the true middle is in the ball: the radius is the
  ///           distance to the corner of the cube that is farthest from `center`, rounded down.
  explicit ToleranceBalls(const Problem& problem);

  [[nodiscard]] std::span<const Ball> balls() const noexcept { return balls_; }

  /// Returns the part of the axis of a variable that is in its ball; nullopt for other variables.
  [[nodiscard]] std::optional<Interval> axis(std::size_t variable) const noexcept;

  /// Moves each point that may be outside its ball to a place inside it, near its surface.
  void pull_in(std::span<double> variables) const noexcept;

  /// Returns true only if all points are in their balls.
  [[nodiscard]] bool certain_inside(std::span<const double> variables) const noexcept;

 private:
  std::vector<Ball> balls_;
};

}  // namespace regulus::detail
