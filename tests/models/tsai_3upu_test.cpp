// SPDX-License-Identifier: GPL-3.0-or-later
// Tsai's 3-UPU robot shows why the full matrix is needed.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::tsai_3upu {
namespace {

const ShippedModel& robot() {
  static const ShippedModel model("tsai_3upu");
  return model;
}
const ShippedModel& reduced() {
  static const ShippedModel model("tsai_3upu_reduced");
  return model;
}

constexpr double kBase = 30, kPlatform = 10;
Vector<double> outward(std::size_t i) { return direction(120 * double(i)); }
Vector<double> tangent(std::size_t i) { return direction(120 * double(i) + 90); }

Dual length(std::size_t i, const MovingBody& body) {
  return norm(body.at(kPlatform * outward(i)) - constant(kBase * outward(i)));
}

/// Returns a triple product that stays 0. Both inner axes of a leg are one direction, at right
/// angles to the leg and both outer axes, so these three are coplanar.
Dual twisted(std::size_t i, const MovingBody& body) {
  const Vector<Dual> leg = body.at(kPlatform * outward(i)) - constant(kBase * outward(i));
  return dot(cross(constant(tangent(i)), leg), body.along(tangent(i)));
}

Point random_pose(Poses& poses) {
  return {
      {"x", poses.between(-50, 50)}, {"y", poses.between(-50, 50)}, {"z", poses.between(5, 60)}};
}

TEST(Tsai3Upu, HasTheDerivativesOfItsConstraints) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    const Point pose = random_pose(poses);
    const Rows rows = robot().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      expect_equal(rows[i], derivatives(pose, [i](const MovingBody& b) { return length(i, b); }));
      expect_equal(rows[3 + i],
                   derivatives(pose, [i](const MovingBody& b) { return twisted(i, b); }), -1);
    }
  }
}

TEST(Tsai3Upu, HasAReducedMatrixThatLeavesTheConstraintsOut) {
  Poses poses;
  const Point pose = random_pose(poses);
  const Rows rows = reduced().matrix(pose);
  for (std::size_t i = 0; i < 3; ++i) {
    Row lengths = derivatives(pose, [i](const MovingBody& b) { return length(i, b); });
    lengths.resize(3);
    expect_equal(rows[i], lengths);
  }
}

/// Returns 0 on a cylinder whose radius is twice the difference of base and platform.
double cylinder(double x, double y) {
  return x * x + y * y - 4 * (kBase - kPlatform) * (kBase - kPlatform);
}

TEST(Tsai3Upu, IsSingularExactlyOnACylinder) {
  for (const char* z : {"z=20", "z=45"}) {
    const Paving paving(robot(),
                        {"wide", "--range", "x=-55:50", "--range", "y=-50:55", "--range", z,
                         "--resolution", "1/32"},
                        "x", "y");
    paving.expect_to_agree_with(cylinder);
    EXPECT_GT(paving.count("singular"), 60U);
    EXPECT_GT(paving.fraction("free"), 0.85);
  }
}

TEST(Tsai3Upu, IsSingularThoughItsReducedMatrixIsNot) {
  const auto report = robot().check({"wide"});
  ASSERT_EQ(report["verdict"], "singularity");
  const auto& pose = report["witness"]["points"][0]["pose"];
  EXPECT_NEAR(cylinder(pose["x"][0], pose["y"][0]), 0, 1e-9);
  EXPECT_EQ(reduced().verdict({"wide"}), "no-singularity");
}

TEST(Tsai3Upu, IsSingularOnACircleOnTheCylinder) {
  EXPECT_EQ(robot().verdict({"circle_40"}), "singularity");
  EXPECT_EQ(robot().verdict({"circle_39"}), "no-singularity");
  EXPECT_EQ(reduced().verdict({"circle_40"}), "no-singularity");
}

}  // namespace
}  // namespace regulus::detail::test::tsai_3upu
