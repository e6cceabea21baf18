// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle on three legs, each a prismatic joint between two revolute ones: the robot of
// models/planar_3rpr.toml. The constants are the lengths of the triangle's sides, so the law of
// cosines gives the anchors.
#include <regulus/regulus.hpp>

using regulus::Formula;
using regulus::Robot;

Robot regulus_model() {
  Robot robot("planar 3-RPR");
  robot.source(
      "Innocenti and Parenti-Castelli's robot, as in M. Zein, P. Wenger, D. Chablat, 2007");
  const Formula x = robot.pose("x"), y = robot.pose("y"), phi = robot.pose("phi", "rad");

  const auto a1 = robot.point("a1", {0, 0}, 0, "base");
  const auto a2 = robot.point("a2", {"15.91", 0}, 0, "base");
  const auto a3 = robot.point("a3", {0, 10}, 0, "base");
  const Formula side_12 = robot.uncertain("side_12", "17.04", 0, "platform");
  const Formula side_23 = robot.uncertain("side_23", "16.54", 0, "platform");
  const Formula side_31 = robot.uncertain("side_31", "20.84", 0, "platform");

  const Formula c = robot.let("c", cos(phi)), s = robot.let("s", sin(phi));
  // B3 in the frame of the triangle; B2 is (side_12, 0).
  const Formula u3 =
      robot.let("u3", (pow(side_12, 2) + pow(side_31, 2) - pow(side_23, 2)) / (2 * side_12));
  const Formula v3 = robot.let("v3", sqrt(pow(side_31, 2) - pow(u3, 2)));
  // B1B_i in the reference frame, and A_iB_i.
  const Formula r2_x = robot.let("r2_x", side_12 * c), r2_y = robot.let("r2_y", side_12 * s);
  const Formula r3_x = robot.let("r3_x", u3 * c - v3 * s);
  const Formula r3_y = robot.let("r3_y", u3 * s + v3 * c);
  const Formula e1_x = robot.let("e1_x", x - a1[0]), e1_y = robot.let("e1_y", y - a1[1]);
  const Formula e2_x = robot.let("e2_x", x + r2_x - a2[0]);
  const Formula e2_y = robot.let("e2_y", y + r2_y - a2[1]);
  const Formula e3_x = robot.let("e3_x", x + r3_x - a3[0]);
  const Formula e3_y = robot.let("e3_y", y + r3_y - a3[1]);

  // (A_iB_i, B1B_i × A_iB_i), and B1B × AB = B1B × (B1 − A), which uses phi less often.
  robot.matrix({{e1_x, e1_y, 0},
                {e2_x, e2_y, r2_x * (y - a2[1]) - r2_y * (x - a2[0])},
                {e3_x, e3_y, r3_x * (y - a3[1]) - r3_y * (x - a3[0])}});
  robot.row_scale({1 / sqrt(e1_x * e1_x + e1_y * e1_y), 1 / sqrt(e2_x * e2_x + e2_y * e2_y),
                   1 / sqrt(e3_x * e3_x + e3_y * e3_y)});

  robot.motion("regular").range(x, -2, 4).range(y, 13, 18).range(phi, "-15*deg", "5*deg");
  robot.motion("crossing").range(x, -2, 4).range(y, 13, 18).range(phi, "-15*deg", "60*deg");
  auto& circle = robot.motion("circle");
  const Formula T = circle.parameter("T", 0, 1);
  circle.pose(x, 1 + 3 * cos("2*pi" * T)).pose(y, 15 + 3 * sin("2*pi" * T)).pose(phi, "-5*deg");
  circle.error(x, "0.01").error(y, "0.01").error(phi, "0.001");
  // Legs between 5 and 35.
  robot.motion("reach")
      .range(x, -2, 4)
      .range(y, 13, 18)
      .range(phi, "-15*deg", "5*deg")
      .constraint(25 - pow(e1_x, 2) - pow(e1_y, 2))
      .constraint(pow(e3_x, 2) + pow(e3_y, 2) - 35 * 35);
  return robot;
}
