// SPDX-License-Identifier: GPL-3.0-or-later
// The robot of codegen/model/robot/AUTHORS.md.
#include <regulus/regulus.hpp>

using regulus::Formula;
using regulus::Robot;
using namespace regulus::literals;

Robot regulus_model() {
  Robot robot("slider");
  const Formula x = robot.pose("x", "cm"), phi = robot.pose("phi", "rad");
  const Formula h = robot.uncertain("h", "1/3", 0.01_exact, "platform");
  robot.matrix({{x - h * cos(phi), 1}, {h * sin(phi), cos(phi)}});
  robot.motion("near").range(x, 2, 5).range(phi, "-10*deg", "10*deg");
  auto& swing = robot.motion("swing");
  const Formula T = swing.parameter("T", 0, 1);
  swing.pose(x, 3 + T).pose(phi, sin(2 * Formula("pi") * T) / 10).error(x, 0.01_exact);
  return robot;
}
