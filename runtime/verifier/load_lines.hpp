// SPDX-License-Identifier: Apache-2.0
// The lines of a certificate about a load and the limits of the forces that hold it.
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Reads from the current line, `load NAME`, up to the line after the last `limits`. Then puts the
/// scales into the rows of the matrix. Throws Rejection.
///
/// Requires  question.load has the verdict.
void read_load_lines(Lines& lines, Question& question);

/// The limits and the load in doubles.
struct LoadBounds {
  std::vector<Interval> certain;   ///< by row: forces in it are within the limits
  std::vector<Interval> possible;  ///< by row: forces outside it are beyond a limit
  std::vector<bool> is_free;       ///< by row: the force has no limits; both are [0, 0]
  std::vector<Interval> middle;    ///< by column
  std::vector<Interval> spread;    ///< by column, ≥ 0
  struct Ball {
    Interval radius;
    std::vector<std::size_t> members;
  };
  std::vector<Ball> balls;
  /// Each encloses a wrench; their convex hull is the load without the balls.
  std::vector<std::vector<Interval>> corners;
};

/// Rounding  `certain` inward, all else outward.
/// Throws    Rejection if limits are empty, or a spread or a radius is negative; Unfinished if this
///           is not certain, or if no double lies within the limits.
[[nodiscard]] LoadBounds enclose_load(const Question& question);

}  // namespace regulus::verifier
