// SPDX-License-Identifier: GPL-3.0-or-later
// Angles of a pose against quaternions that are products of turns about the axes.
#include "codegen/question/solve/own_pose.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "codegen/model/file/model_file.hpp"

namespace regulus::detail {
namespace {

constexpr double kPi = std::numbers::pi;

using Quaternion = std::array<double, 4>;

Quaternion times(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// `axis`: 1, 2 or 3.
Quaternion turn(std::size_t axis, double angle) {
  Quaternion q{std::cos(angle / 2), 0, 0, 0};
  q[axis] = std::sin(angle / 2);
  return q;
}

Model hexapod(const std::string& orientation, const std::string& angle_unit) {
  return parse_model(
      "regulus = 1\nname = \"m\"\n[gough]\norientation = \"" + orientation +
          "\"\nunit = \"cm\"\nangle_unit = \"" + angle_unit +
          "\"\nbase = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, "
          "0]]\n"
          "platform = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]\n"
          "[motion.a]\nx = 0\ny = 0\nz = 9\n" +
          (orientation == "euler-zxz" ? "psi = 0\ntheta = 0\nphi = 0\n"
                                      : "roll = 0\npitch = 0\nyaw = 0\n"),
      "m");
}

/// Returns x y z and the quaternion within 1e-12; `sign`: of the quaternion.
std::vector<Interval> pose_of(const Quaternion& q, double sign = 1) {
  std::vector<Interval> pose{Interval(1.0), Interval(2.0), Interval(3.0)};
  for (const double part : q) pose.push_back({sign * part - 1e-12, sign * part + 1e-12});
  return pose;
}

void expect_angles(const std::vector<Interval>& values, const std::array<double, 3>& angles,
                   double unit = 1) {
  ASSERT_EQ(values.size(), 6U);
  EXPECT_EQ(values[0], Interval(1.0));
  EXPECT_EQ(values[2], Interval(3.0));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(values[3 + i].lo, angles[i] / unit + 1e-13) << i;
    EXPECT_GE(values[3 + i].hi, angles[i] / unit - 1e-13) << i;
    EXPECT_LT(values[3 + i].hi - values[3 + i].lo, 1e-8 / unit) << i;
  }
}

TEST(OwnPose, HasRollPitchAndYaw) {
  const OwnPose own(hexapod("roll-pitch-yaw", "rad"));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> whole(-kPi, kPi), half(-1.5, 1.5);
  for (int i = 0; i < 500; ++i) {
    const double roll = whole(random), pitch = half(random), yaw = whole(random);
    const Quaternion q = times(turn(3, yaw), times(turn(2, pitch), turn(1, roll)));
    expect_angles(own.at(pose_of(q, i % 2 == 0 ? 1 : -1)), {roll, pitch, yaw});
  }
}

TEST(OwnPose, HasEulersAngles) {
  const OwnPose own(hexapod("euler-zxz", "deg"));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> whole(-kPi, kPi), tilt(0.05, kPi - 0.05);
  for (int i = 0; i < 500; ++i) {
    const double psi = whole(random), theta = tilt(random), phi = whole(random);
    const Quaternion q = times(turn(3, psi), times(turn(1, theta), turn(3, phi)));
    expect_angles(own.at(pose_of(q, i % 2 == 0 ? 1 : -1)), {psi, theta, phi}, kPi / 180);
  }
}

TEST(OwnPose, EnclosesAnglesOnBothSidesOfHalfATurn) {
  const OwnPose own(hexapod("roll-pitch-yaw", "rad"));
  const std::vector<Interval> values = own.at(pose_of(turn(3, kPi)));
  EXPECT_LT(values[5].hi - values[5].lo, 1e-10);
  EXPECT_LT(std::fabs(std::fabs(mid(values[5])) - kPi), 1e-10);
}

TEST(OwnPose, LeavesAnglesOpenThatTheRotationDoesNotHave) {
  const OwnPose rolls(hexapod("roll-pitch-yaw", "rad"));
  EXPECT_FALSE(rolls.is_ambiguous(pose_of(turn(3, 0.3))));
  const std::vector<Interval> upright = pose_of(times(turn(3, 0.3), turn(2, kPi / 2)));
  EXPECT_TRUE(rolls.is_ambiguous(upright));
  EXPECT_LE(rolls.at(upright)[3].lo, -3.14);
  EXPECT_GE(rolls.at(upright)[3].hi, 3.14);
  EXPECT_LT(std::fabs(mid(rolls.at(upright)[4]) - kPi / 2), 1e-5);
  EXPECT_TRUE(OwnPose(hexapod("euler-zxz", "rad")).is_ambiguous(pose_of(turn(3, 0.3))));
}

TEST(OwnPose, HasNoAnglesWhereTheModelHasAQuaternion) {
  const Model model = parse_model(
      "regulus = 1\nname = \"m\"\n[gough]\norientation = \"quaternion\"\nunit = \"cm\"\n"
      "base = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]\n"
      "platform = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]\n"
      "[motion.a]\nx = 0\ny = 0\nz = 9\nq0 = 1\nq1 = 0\nq2 = 0\nq3 = 0\n",
      "m");
  EXPECT_FALSE(OwnPose(model).has_angles());
}

}  // namespace
}  // namespace regulus::detail
