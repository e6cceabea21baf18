// SPDX-License-Identifier: GPL-3.0-or-later
// The 6-RUS hexapod has cranks in vertical planes and rods of constant length.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::hexapod_6rus {
namespace {

constexpr double kCrank = 36, kRod = 125;
constexpr double kBaseAngles[] = {74.9, 105.1, 194.9, 225.1, 314.9, 345.1};
constexpr double kPlatformAngles[] = {82.9, 97.1, 202.9, 217.1, 322.9, 337.1};
constexpr double kSwingAngles[] = {0, 180, 120, 300, 240, 60};

const ShippedModel& robot() {
  static const ShippedModel model("hexapod_6rus");
  return model;
}

Vector<double> base(std::size_t i) { return 65.43 * direction(kBaseAngles[i]); }
Vector<double> platform(std::size_t i) { return 76.35 * direction(kPlatformAngles[i]); }
/// Returns the direction away from the other motor of the pair.
Vector<double> swing(std::size_t i) { return direction(kSwingAngles[i]); }

/// Returns the tip of the crank. The rod's length allows two angles; this takes the one that leans
/// out more.
Vector<double> tip(std::size_t i, const Vector<double>& joint) {
  const Vector<double> AB = joint - base(i), f = swing(i), up = {0, 0, 1};
  const double along = dot(AB, f), height = AB[2];
  const double cosine =
      (dot(AB, AB) + kCrank * kCrank - kRod * kRod) / (2 * kCrank * std::hypot(along, height));
  const double angle = std::atan2(height, along) - std::acos(cosine);
  return base(i) + kCrank * std::cos(angle) * f + kCrank * std::sin(angle) * up;
}

/// Returns ∂|CB|/∂(pose) over ∂|CB|/∂(motor), for a constant length of the rod.
Row motor_rate(std::size_t i, const Point& pose) {
  const MovingBody still(position_of(pose), pose.at("roll"), pose.at("pitch"), pose.at("yaw"), 0);
  const Vector<double> joint = values(still.at(platform(i))), C = tip(i, joint);
  Row row = derivatives(
      pose, [&](const MovingBody& body) { return norm(body.at(platform(i)) - constant(C)); });
  const Vector<double> crank = C - base(i), f = swing(i), up = {0, 0, 1};
  const Vector<double> velocity = dot(crank, f) * up - crank[2] * f;
  const double by_motor = dot(velocity, (1 / kRod) * (joint - C));
  for (double& entry : row) entry /= by_motor;
  return row;
}

TEST(Hexapod6Rus, HasTheMotorsRates) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    const Point pose{{"x", poses.between(-15, 15)},       {"y", poses.between(-15, 15)},
                     {"z", poses.between(112, 128)},      {"roll", poses.between(-0.2, 0.2)},
                     {"pitch", poses.between(-0.2, 0.2)}, {"yaw", poses.between(-0.2, 0.2)}};
    const Rows rows = robot().matrix(pose);
    for (std::size_t i = 0; i < 6; ++i) expect_equal(rows[i], motor_rate(i, pose));
  }
}

/// Returns the determinant of the rods' Plücker coordinates, with moments about the base: it is 0
/// where the six lines are dependent.
double dependent_rods(double z, double yaw) {
  const MovingBody body({0, 0, z}, 0, 0, yaw, 0);
  Rows lines;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector<double> B = values(body.at(platform(i))), C = tip(i, B);
    const Vector<double> along = B - C, moment = cross(C, along);
    lines.push_back({along[0], along[1], along[2], moment[0], moment[1], moment[2]});
  }
  return approx_determinant(lines);
}

TEST(Hexapod6Rus, IsSingularExactlyWhereItsRodsAreDependent) {
  const Paving paving(robot(), {"turn", "--resolution", "1/32", "--engine", "interpreted"}, "z",
                      "yaw");
  paving.expect_to_agree_with(dependent_rods);
  EXPECT_GT(paving.count("singular"), 10U);
  EXPECT_GT(paving.fraction("free"), 0.8);
}

TEST(Hexapod6Rus, ShowsAPoseWhereItsRodsAreDependent) {
  const auto report = robot().check({"turn", "--engine", "interpreted"});
  ASSERT_EQ(report["verdict"], "singularity");
  const auto& pose = report["witness"]["points"][0]["pose"];
  EXPECT_NEAR(dependent_rods(pose["z"][0], pose["yaw"][0]) / dependent_rods(120, 0), 0, 1e-9);
}

}  // namespace
}  // namespace regulus::detail::test::hexapod_6rus
