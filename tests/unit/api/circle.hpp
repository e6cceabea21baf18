// SPDX-License-Identifier: GPL-3.0-or-later
// A robot whose singular poses are known, and how it is asked.
#pragma once

#include "codegen/use/api/regulus.hpp"

namespace regulus::detail::test {

/// Returns a robot with det = x² + y² − h², singular on a circle of radius h.
inline Robot circle() {
  Robot robot("circle");
  const Formula x = robot.pose("x", "cm"), y = robot.pose("y", "cm");
  const Formula h = robot.uncertain("h", 1, 0, "platform");
  robot.matrix({{x - h, y}, {-y, x + h}});
  robot.motion("outside").range(x, 2, 3).range(y, 2, 3);
  robot.motion("across").range(x, -3, 3).range(y, -3, 3);
  return robot;
}

inline SearchOptions interpreted() {
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  return options;
}

}  // namespace regulus::detail::test
