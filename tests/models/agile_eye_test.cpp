// SPDX-License-Identifier: GPL-3.0-or-later
// The Agile Eye has six curves of self-motions and is regular everywhere else.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test {
namespace {

const ShippedModel& robot() {
  static const ShippedModel model("agile_eye");
  return model;
}

const Vector<double> kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The axes of leg i: w ⟂ u, at the motor's angle, and w ⟂ v; v turns with the platform.
struct Leg {
  Vector<double> u, v, w;
};
Leg leg(std::size_t i, const Point& pose) {
  const MovingBody body({0, 0, 0}, pose.at("psi"), pose.at("theta"), pose.at("phi"), 3);
  const Vector<double> u = kAxes[i], v = values(body.along(kAxes[(i + 1) % 3]));
  const Vector<double> w = cross(u, v);
  return {u, v, (1 / norm(w)) * w};
}

/// The rates follow from w·v = 0: (u × w)·v θ' + w·(ω × v) = 0.
TEST(AgileEye, HasTheMotorsRates) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    const Point pose{{"phi", poses.between(-3, 3)},
                     {"theta", poses.between(-1.5, 1.5)},
                     {"psi", poses.between(-3, 3)}};
    const Rows rows = robot().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      const Leg at = leg(i, pose);
      const double by_motor = dot(cross(at.u, at.w), at.v);
      Row rate;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const MovingBody body({0, 0, 0}, pose.at("psi"), pose.at("theta"), pose.at("phi"),
                              3 + axis);
        rate.push_back(-dot(constant(at.w), body.along(kAxes[(i + 1) % 3])).slope / by_motor);
      }
      const double closeness = dot(at.u, at.v);
      expect_equal(rows[i], rate, 1 - closeness * closeness);
    }
  }
}

/// The determinant in closed form: a sum of two squares times cos²θ, 0 on the six curves only.
TEST(AgileEye, HasADeterminantThatIsNeverNegative) {
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    const double phi = poses.between(-3, 3), theta = poses.between(-3, 3),
                 psi = poses.between(-3, 3);
    const double first =
        std::cos(phi) * std::cos(psi) + std::sin(theta) * std::sin(phi) * std::sin(psi);
    const double second = std::cos(theta) * std::sin(phi) * std::sin(psi);
    const double expected = std::pow(std::cos(theta), 2) * (first * first + second * second);
    EXPECT_NEAR(approx_determinant(robot().matrix({{"phi", phi}, {"theta", theta}, {"psi", psi}})),
                expected, 1e-14);
  }
}

/// The slice θ = 0.3 crosses the curves at four points; only there it is singular.
TEST(AgileEye, IsCertifiedFreeAllButAroundItsCurves) {
  const Paving paving(robot(),
                      {"wide", "--range", "phi=-100*deg:105*deg", "--range", "psi=-105*deg:100*deg",
                       "--range", "theta=0.3", "--resolution", "1/64"},
                      "phi", "psi");
  EXPECT_EQ(paving.count("singular"), 0U);
  EXPECT_GT(paving.fraction("free"), 0.98);
  for (const double sign : {-1, 1}) {
    EXPECT_FALSE(paving.is_free(0, sign * 90 * kDegree));
    EXPECT_FALSE(paving.is_free(sign * 90 * kDegree, 0));
    EXPECT_TRUE(paving.is_free(10 * kDegree, sign * 80 * kDegree));
  }
}

TEST(AgileEye, MovesByItselfAlongACurve) {
  EXPECT_EQ(robot().check({"self_motion"})["claim"],
            "the reduced 3×3 matrix is singular at every pose of the motion");
  const auto report = robot().check({"near_a_curve", "--max-boxes", "2000"});
  EXPECT_EQ(report["verdict"], "singularity");
  EXPECT_EQ(report["witness"]["points"][0]["exact"]["psi"], "pi/2");
  EXPECT_EQ(robot().verdict({"wide"}), "no-singularity");
}

}  // namespace
}  // namespace regulus::detail::test
