// SPDX-License-Identifier: GPL-3.0-or-later
// A platform on six legs, each between an anchor A_i of the base and B_i of the platform, with the
// numbers of models/robot_1.toml. [gough] in a model file says the same in three lines; start from
// this file for a robot that differs from it.
#include <array>
#include <regulus/regulus.hpp>
#include <string>

using regulus::Formula;
using regulus::Robot;

namespace {

using Vector = std::array<Formula, 3>;
using Anchors = std::array<std::array<int, 3>, 6>;

constexpr Anchors kBase{
    {{-9, 9, 0}, {9, 9, 0}, {12, -3, 0}, {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}}};
constexpr Anchors kPlatform{
    {{-3, 7, 0}, {3, 7, 0}, {7, -1, 0}, {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}}};

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

std::string numbered(const char* letter, std::size_t i) {
  return std::string(letter).append(std::to_string(i + 1));
}

/// Its coordinates are exact; `--tolerance GROUP=E` makes them ± E.
Vector anchor(Robot& robot, const std::string& name, const std::array<int, 3>& at,
              const std::string& group) {
  return {robot.uncertain(name + "_x", at[0], 0, group),
          robot.uncertain(name + "_y", at[1], 0, group),
          robot.uncertain(name + "_z", at[2], 0, group)};
}

/// The rows of Rz(psi)·Rx(theta)·Rz(phi).
std::array<Vector, 3> rotation(Robot& robot) {
  const Formula psi = robot.pose("psi", "rad"), theta = robot.pose("theta", "rad"),
                phi = robot.pose("phi", "rad");
  const Formula cp = cos(psi), sp = sin(psi), ct = cos(theta), st = sin(theta), cf = cos(phi),
                sf = sin(phi);
  return {{{cp * cf - sp * ct * sf, -cp * sf - sp * ct * cf, sp * st},
           {sp * cf + cp * ct * sf, -sp * sf + cp * ct * cf, -cp * st},
           {st * sf, st * cf, ct}}};
}

/// |x|, |y| ≤ side, 45 ≤ z ≤ 50, and each angle within ±`degrees`.
void add_box(Robot& robot, const std::string& name, int side, int degrees) {
  auto& motion = robot.motion(name);
  motion.range("x", -side, side).range("y", -side, side).range("z", 45, 50);
  const Formula angle = Formula(degrees) * "deg";
  for (const char* parameter : {"psi", "theta", "phi"}) motion.range(parameter, -angle, angle);
}

}  // namespace

Robot regulus_model() {
  Robot robot("robot 1, in C++");
  robot.source("J.-P. Merlet, IEEE Transactions on Robotics 23(3), 2007, Table III");
  const Vector C{robot.pose("x", "cm"), robot.pose("y", "cm"), robot.pose("z", "cm")};
  const std::array<Vector, 3> R = rotation(robot);

  std::array<Vector, 6> A, B;
  for (std::size_t i = 0; i < 6; ++i) A[i] = anchor(robot, numbered("a", i), kBase[i], "base");
  for (std::size_t i = 0; i < 6; ++i)
    B[i] = anchor(robot, numbered("b", i), kPlatform[i], "platform");

  // Row i is (A_iB_i, CB_i × A_iB_i), and CB × AB = CB × AC, which uses the angles less often.
  std::vector<std::vector<Formula>> rows;
  std::vector<Formula> scales;
  for (std::size_t i = 0; i < 6; ++i) {
    Vector CB, AC, AB;
    for (std::size_t k = 0; k < 3; ++k) {
      CB[k] = R[k][0] * B[i][0] + R[k][1] * B[i][1] + R[k][2] * B[i][2];
      AC[k] = C[k] - A[i][k];
      AB[k] = AC[k] + CB[k];
    }
    const Vector moment = cross(CB, AC);
    rows.push_back({AB[0], AB[1], AB[2], moment[0], moment[1], moment[2]});
    scales.push_back(1 / sqrt(pow(AB[0], 2) + pow(AB[1], 2) + pow(AB[2], 2)));
  }
  robot.matrix(rows);
  robot.row_scale(scales);

  add_box(robot, "table4_5", 5, 5);
  add_box(robot, "wide_15", 15, 15);
  add_box(robot, "wide_40", 15, 40);
  return robot;
}
