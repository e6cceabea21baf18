// SPDX-License-Identifier: GPL-3.0-or-later
// The planar 3-RRR robot is singular if the lines of its three links meet or are parallel.
#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/model/overrides.hpp"
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::planar_3rrr {
namespace {

const ShippedModel& robot() {
  static const ShippedModel model("planar_3rrr");
  return model;
}

constexpr double kCrank = 25, kLink = 25;
const Vector<double> kBase[] = {{0, 0, 0}, {60, 0, 0}, {30, 52, 0}};
const Vector<double> kPlatform[] = {{-9, -5, 0}, {9, -5, 0}, {0, 10, 0}};

/// Returns the motor's angle by the law of cosines; the crank is left of A_iB_i, seen from A_i.
double motor_angle(const Vector<double>& AB) {
  const double length = norm(AB);
  const double inner =
      std::acos((length * length + kCrank * kCrank - kLink * kLink) / (2 * length * kCrank));
  return std::atan2(AB[1], AB[0]) + inner;
}

struct Link {
  Vector<double> elbow, tip;
};

Link link(std::size_t i, double x, double y, double phi) {
  const Vector<double> tip = values(MovingBody({x, y, 0}, 0, 0, phi, 0).at(kPlatform[i]));
  const double angle = motor_angle(tip - kBase[i]);
  return {kBase[i] + kCrank * direction(angle / kDegree), tip};
}

/// The link keeps its length, so the motor compensates the change of the pose. It turns clockwise,
/// so that the rate grows with |CB|.
TEST(Planar3Rrr, HasTheMotorsRates) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    Point pose{{"x", poses.between(24, 36)},
               {"y", poses.between(12, 22)},
               {"z", 0},
               {"phi", poses.between(-0.3, 0.3)}};
    const Rows rows = robot().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      const Link at = link(i, pose["x"], pose["y"], pose["phi"]);
      Row of_length;
      for (const std::size_t twist : {0, 1, 5}) {
        const MovingBody body(position_of(pose), 0, 0, pose["phi"], twist);
        of_length.push_back(norm(body.at(kPlatform[i]) - constant(at.elbow)).slope);
      }
      const Vector<double> crank = at.elbow - kBase[i];
      const Vector<double> along = (1 / kLink) * (at.tip - at.elbow);
      const double by_motor = dot(along, Vector<double>{crank[1], -crank[0], 0});
      EXPECT_GT(by_motor, 0);
      expect_equal(rows[i], of_length, 1 / by_motor);
    }
  }
}

/// Returns the third line's moment about the point where the first two meet, times the sine of
/// their angle: 0 where three lines of a plane meet in a point or are parallel.
double meeting_links(double x, double y, double phi) {
  Row lines[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Link at = link(i, x, y, phi);
    const Vector<double> along = at.tip - at.elbow;
    lines[i] = {along[0], along[1], at.elbow[0] * along[1] - at.elbow[1] * along[0]};
  }
  return approx_determinant({lines[0], lines[1], lines[2]});
}

TEST(Planar3Rrr, IsSingularExactlyWhereTheLinksMeet) {
  const Paving paving(robot(),
                      {"crossing", "--range", "y=17", "--range", "x=20:40", "--range",
                       "phi=-80*deg:80*deg", "--resolution", "1/32"},
                      "x", "phi");
  paving.expect_to_agree_with([](double x, double phi) { return meeting_links(x, 17, phi); });
  EXPECT_GT(paving.count("singular"), 25U);
  EXPECT_GT(paving.fraction("free"), 0.85);
}

TEST(Planar3Rrr, ShowsAPoseWhereTheLinksMeet) {
  const auto report = robot().check({"crossing"});
  ASSERT_EQ(report["verdict"], "singularity");
  const auto& pose = report["witness"]["points"][0]["pose"];
  EXPECT_NEAR(
      meeting_links(pose["x"][0], pose["y"][0], pose["phi"][0]) / (kLink * kLink * kBase[1][0]), 0,
      1e-9);
}

/// When they were multiplied out and differentiated, a leg's root and quotient gave hundreds of
/// thousands of operations.
TEST(Planar3Rrr, HasFunctionsOfModerateLength) {
  const Model& model = robot().model();
  FormulationOptions options;
  options.right_product = false;
  const Module module = lower(formulate(model, find_motion(model, "regular"), options));
  EXPECT_LT(module.find("left_product")->program.nodes.size(), 1000U);
  EXPECT_LT(module.find("left_derivatives")->program.nodes.size(), 4000U);
}

}  // namespace
}  // namespace regulus::detail::test::planar_3rrr
