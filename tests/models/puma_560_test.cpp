// SPDX-License-Identifier: GPL-3.0-or-later
// The PUMA 560 is a serial arm; the determinant of its forward Jacobian has a closed form.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::puma_560 {
namespace {

const ShippedModel& robot() {
  static const ShippedModel model("puma_560");
  return model;
}

/// Modified Denavit-Hartenberg parameters, a row for each joint: α and a before it, d along it.
struct Joint {
  double alpha, a, d;
};
constexpr Joint kArm[] = {
    {0, 0, 0},   {-90, 0, 0.2435}, {0, 0.4318, -0.0934}, {90, -0.0203, 0.4331},
    {-90, 0, 0}, {90, 0, 0}};

/// The axis of a joint and a point on it, in the frame of the base.
struct Axis {
  Vector<double> direction, point;
};
std::array<Axis, 6> axes(const std::array<double, 6>& q) {
  std::array<Axis, 6> result;
  for (std::size_t joint = 0; joint < 6; ++joint) {
    Vector<double> z = {0, 0, 1}, origin = {0, 0, 0};
    for (std::size_t k = joint + 1; k-- > 0;) {
      const Joint& j = kArm[k];
      z = turned(0, j.alpha * kDegree, turned(2, q[k], z));
      origin = Vector<double>{j.a, 0, 0} +
               turned(0, j.alpha * kDegree, Vector<double>{0, 0, j.d} + turned(2, q[k], origin));
    }
    result[joint] = {z, origin};
  }
  return result;
}

Point named(const std::array<double, 6>& q) {
  return {{"q1", q[0]}, {"q2", q[1]}, {"q3", q[2]}, {"q4", q[3]}, {"q5", q[4]}, {"q6", q[5]}};
}

/// Column k has the velocity of the wrist's centre and the axis itself, turned back about joint 1.
TEST(Puma560, HasTheColumnsOfItsJointAxes) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    std::array<double, 6> q{};
    for (double& angle : q) angle = poses.between(-3, 3);
    const Rows rows = robot().matrix(named(q));
    const auto axis = axes(q);
    for (std::size_t k = 0; k < 6; ++k) {
      const Vector<double> velocity =
          turned(2, -q[0], cross(axis[k].direction, axis[5].point - axis[k].point));
      const Vector<double> spin = turned(2, -q[0], axis[k].direction);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(rows[i][k], velocity[i], 1e-14) << "joint " << k + 1;
        EXPECT_NEAR(rows[3 + i][k], spin[i], 1e-14) << "joint " << k + 1;
      }
    }
  }
}

double elbow(double q3) { return 0.4331 * std::cos(q3) + 0.0203 * std::sin(q3); }
double shoulder(double q2, double q3) {
  return 0.4318 * std::cos(q2) - 0.0203 * std::cos(q2 + q3) + 0.4331 * std::sin(q2 + q3);
}

TEST(Puma560, HasTheDeterminantInClosedForm) {
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    std::array<double, 6> q{};
    for (double& angle : q) angle = poses.between(-3, 3);
    EXPECT_NEAR(approx_determinant(robot().matrix(named(q))),
                0.4318 * elbow(q[2]) * shoulder(q[1], q[2]) * std::sin(q[4]), 1e-14);
  }
}

/// The ranges omit the folded arm, where both singularities are within two millimetres.
TEST(Puma560, IsSingularExactlyAtElbowAndShoulder) {
  const Paving paving(robot(),
                      {"elbow", "--range", "q2=-170*deg:150*deg", "--range", "q3=-50*deg:130*deg",
                       "--resolution", "1/32"},
                      "q2", "q3");
  paving.expect_to_agree_with([](double q2, double q3) { return elbow(q3) * shoulder(q2, q3); });
  EXPECT_GT(paving.count("singular"), 60U);
  EXPECT_GT(paving.fraction("free"), 0.8);
}

TEST(Puma560, ShowsEachKindOfSingularity) {
  const auto pose_of = [](const char* motion) {
    const auto report = robot().check({motion});
    EXPECT_EQ(report["verdict"], "singularity") << motion;
    return report["witness"]["points"][0]["pose"];
  };
  EXPECT_NEAR(std::sin(pose_of("wrist")["q5"][0].get<double>()), 0, 1e-12);
  EXPECT_NEAR(elbow(pose_of("elbow")["q3"][0]), 0, 1e-12);
  const auto pose = pose_of("shoulder");
  EXPECT_NEAR(shoulder(pose["q2"][0], pose["q3"][0]), 0, 1e-12);
  EXPECT_EQ(robot().check({"ready"})["claim"],
            "the full 6×6 matrix is singular at every pose of the motion");
  EXPECT_EQ(robot().verdict({"dexterous"}), "no-singularity");
}

}  // namespace
}  // namespace regulus::detail::test::puma_560
