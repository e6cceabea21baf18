// SPDX-License-Identifier: GPL-3.0-or-later
// The octahedral platform: its legs are edges of an octahedron between two of its faces.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::octahedral {
namespace {

const ShippedModel& octahedral() {
  static const ShippedModel model("octahedral");
  return model;
}

/// Returns a corner of a triangle, at this angle.
Vector<double> corner(double radius, double degrees) { return radius * direction(degrees); }
Vector<double> base(int i) { return corner(10, 90 + 120 * i); }
Vector<double> platform(int i) { return corner(6, 30 + 120 * i); }

/// Leg i joins base corner i/2 to platform corner (i+1)/2.
TEST(Octahedral, HasTheDerivativesOfTheLegLengths) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    Point pose{{"x", poses.between(-3, 3)},     {"y", poses.between(-3, 3)},
               {"z", poses.between(8, 12)},     {"roll", poses.between(-1, 1)},
               {"pitch", poses.between(-1, 1)}, {"yaw", poses.between(-2, 2)}};
    const Rows rows = octahedral().matrix(pose);
    for (int leg = 0; leg < 6; ++leg)
      expect_equal(rows[std::size_t(leg)], derivatives(pose, [leg](const MovingBody& body) {
                     return norm(body.at(platform((leg + 1) / 2 % 3)) - constant(base(leg / 2)));
                   }));
  }
}

/// Returns the plane through three points: normal and offset.
Row plane(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c) {
  const Vector<double> n = cross(b - a, c - a);
  return {n[0], n[1], n[2], dot(n, a)};
}

/// Returns 0 where four alternate faces meet in a point (Blaschke and Liebmann): here the base and
/// the three faces with one corner on it.
double meeting_faces(double y, double pitch, double yaw) {
  const MovingBody body({1, y, 10}, 0, pitch, yaw, 0);
  const auto b = [&body](int i) { return values(body.at(platform(i % 3))); };
  return approx_determinant({plane(base(0), base(1), base(2)), plane(base(0), b(0), b(1)),
                             plane(base(1), b(1), b(2)), plane(base(2), b(2), b(0))});
}

TEST(Octahedral, IsSingularExactlyWhereAlternateFacesMeet) {
  const Paving paving(octahedral(),
                      {"level_91", "--range", "x=1", "--range", "z=10", "--range", "y=-8:8",
                       "--range", "yaw=40*deg:130*deg", "--resolution", "1/32"},
                      "y", "yaw");
  paving.expect_to_agree_with([](double y, double yaw) { return meeting_faces(y, 0, yaw); });
  EXPECT_GT(paving.count("singular"), 20U);
  EXPECT_GT(paving.fraction("free"), 0.9);
}

/// Fichter's singularity is at any position of a platform that is level and turned by 90°.
TEST(Octahedral, IsSingularAfterAQuarterTurn) {
  const auto report = octahedral().check({"level_91"});
  EXPECT_EQ(report["verdict"], "singularity");
  EXPECT_NEAR(std::abs(report["witness"]["points"][0]["pose"]["yaw"][0].get<double>()),
              90 * kDegree, 1e-12);
  EXPECT_EQ(octahedral().verdict({"level_89"}), "no-singularity");
  EXPECT_EQ(octahedral().check({"quarter_turn", "--max-boxes", "500"})["claim"],
            "the full 6×6 matrix is singular at every pose of the motion");
}

TEST(Octahedral, HasTheDeterminantInClosedFormWhenLevel) {
  const auto unscaled = [](double z, double yaw) {
    const Point pose{{"x", 1.5}, {"y", -2}, {"z", z}, {"roll", 0}, {"pitch", 0}, {"yaw", yaw}};
    Rows rows = octahedral().matrix(pose);
    double scale = 1;
    for (const Row& row : rows) scale *= std::hypot(row[0], row[1], row[2]);
    EXPECT_NEAR(scale, 1, 1e-12);
    for (int leg = 0; leg < 6; ++leg) {
      const MovingBody body(position_of(pose), 0, 0, yaw, 0);
      const double length = norm(values(body.at(platform((leg + 1) / 2 % 3))) - base(leg / 2));
      for (double& entry : rows[std::size_t(leg)]) entry *= length;
    }
    return approx_determinant(rows);
  };
  const double factor = unscaled(10, 0) / 1000;
  for (const double z : {3.0, 9.0, 14.0})
    for (const double yaw : {-1.2, 0.4, 1.1, 2.5})
      EXPECT_NEAR(unscaled(z, yaw), factor * z * z * z * std::cos(yaw),
                  1e-9 * std::abs(factor) * z * z * z);
}

}  // namespace
}  // namespace regulus::detail::test::octahedral
