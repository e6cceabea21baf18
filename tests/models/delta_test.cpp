// SPDX-License-Identifier: GPL-3.0-or-later
// The Delta robot by its six rods; each arm has two rods of equal length.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::delta {
namespace {

constexpr double kUpper = 524, kLower = 1244, kWidth = 131;
const double kBase = 567 * std::sqrt(3) / 6, kPlatform = 76 * std::sqrt(3) / 3;

const ShippedModel& robot() {
  static const ShippedModel model("delta");
  return model;
}

Vector<double> outward(std::size_t i) { return direction(-90 + 120 * double(i)); }
Vector<double> sideways(std::size_t i) { return direction(120 * double(i)); }

/// Returns the arm's angle below the horizontal, knee outward, by the law of cosines.
double arm_angle(std::size_t i, const Vector<double>& platform) {
  const double radial = dot(platform, outward(i)) + kPlatform - kBase;
  const double lateral = dot(platform, sideways(i)), height = platform[2];
  const double reach = std::hypot(radial, height);
  const double seen = kLower * kLower - lateral * lateral;  // squared rod length in that plane
  const double inner = std::acos((reach * reach + kUpper * kUpper - seen) / (2 * reach * kUpper));
  return -(std::atan2(height, radial) + inner);
}

Vector<double> knee(std::size_t i, const Vector<double>& platform) {
  const double angle = arm_angle(i, platform);
  return (kBase + kUpper * std::cos(angle)) * outward(i) +
         Vector<double>{0, 0, -kUpper * std::sin(angle)};
}

/// Compares with the worked examples of the source.
TEST(Delta, HasTheArmAnglesOfItsSource) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(arm_angle(i, {0, 0, -900.32}) / kDegree, -20.5, 0.01);
  const double expected[] = {47.5, -11.6, 21.4};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(arm_angle(i, {300.46, 499.94, -1099.83}) / kDegree, expected[i], 0.01);
}

/// Returns the derivative of a rod's length by the pose, for parallelogram i with the arms at rest.
Row rod(std::size_t i, int side, const Point& pose) {
  const Vector<double> offset = (side * kWidth / 2) * sideways(i);
  const Vector<double> C = knee(i, position_of(pose)) + offset;
  return derivatives(pose, [&](const MovingBody& body) {
    return norm(body.at(kPlatform * outward(i) + offset) - constant(C));
  });
}

Row combination(double a, const Row& x, double b, const Row& y) {
  Row sum;
  for (std::size_t j = 0; j < x.size(); ++j) sum.push_back(a * x[j] + b * y[j]);
  return sum;
}

/// The motor acts on half the sum of a pair's rods; their difference keeps the platform level.
TEST(Delta, HasTheRowsOfItsSixRods) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    const Point pose{{"x", poses.between(-400, 400)},
                     {"y", poses.between(-400, 400)},
                     {"z", poses.between(-1150, -850)}};
    const Rows rows = robot().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      const Row left = rod(i, -1, pose), right = rod(i, 1, pose);
      const double angle = arm_angle(i, position_of(pose));
      const Vector<double> velocity = (-kUpper * std::sin(angle)) * outward(i) +
                                      Vector<double>{0, 0, -kUpper * std::cos(angle)};
      const Vector<double> tip = position_of(pose) + kPlatform * outward(i);
      const double by_motor = dot(velocity, (1 / kLower) * (tip - knee(i, position_of(pose))));
      expect_equal(rows[i], combination(0.5 / by_motor, left, 0.5 / by_motor, right));
      expect_equal(rows[3 + i], combination(kLower / kWidth, right, -kLower / kWidth, left));
    }
  }
}

/// Vanishes if the rods are coplanar, or the normals of the parallelograms are.
double volumes(double x, double y, double z) {
  Rows along, normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<double> d = Vector<double>{x, y, z} + kPlatform * outward(i) - knee(i, {x, y, z});
    const Vector<double> n = cross(sideways(i), d);
    along.push_back({d[0], d[1], d[2]});
    normal.push_back({n[0], n[1], n[2]});
  }
  return approx_determinant(along) * approx_determinant(normal);
}

TEST(Delta, IsSingularExactlyWhereRodsOrParallelogramsAreCoplanar) {
  const Paving paving(robot(),
                      {"far", "--range", "x=-100:100", "--range", "y=-1160:-960", "--range",
                       "z=-1000", "--resolution", "1/16"},
                      "x", "y");
  paving.expect_to_agree_with([](double x, double y) { return volumes(x, y, -1000); });
  EXPECT_GT(paving.count("singular"), 10U);
  EXPECT_GT(paving.fraction("free"), 0.8);
}

TEST(Delta, IsRegularWhereItWorks) {
  EXPECT_EQ(robot().verdict({"work"}), "no-singularity");
  EXPECT_EQ(robot().verdict({"far"}), "singularity");
}

}  // namespace
}  // namespace regulus::detail::test::delta
