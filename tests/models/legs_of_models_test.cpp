// SPDX-License-Identifier: GPL-3.0-or-later
// Three robots of [legs]: their rows against the derivatives of their joints, and where they are
// singular.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::legs_of_models {
namespace {

Vector<double> outward(std::size_t i) { return direction(120 * double(i)); }
Vector<double> tangent(std::size_t i) { return direction(120 * double(i) + 90); }

// The robot of Seoul National University.

const ShippedModel& snu() {
  static const ShippedModel model("snu_3upu");
  return model;
}

Vector<Dual> leg_of_snu(std::size_t i, const MovingBody& body) {
  return body.at(10. * outward(i)) - constant(30. * outward(i));
}

TEST(Snu3Upu, HasTheDerivativesOfItsConstraints) {
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    const Point pose{
        {"x", poses.between(-50, 50)}, {"y", poses.between(-50, 50)}, {"z", poses.between(5, 60)}};
    const Rows rows = snu().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      expect_equal(rows[i], derivatives(pose, [i](const MovingBody& body) {
                     return norm(leg_of_snu(i, body));
                   }));
      // Both outer axes of a leg, which are radial, and the leg stay in one plane.
      expect_parallel(rows[3 + i], derivatives(pose, [i](const MovingBody& body) {
                        return dot(cross(constant(outward(i)), leg_of_snu(i, body)),
                                   body.along(outward(i)));
                      }));
    }
  }
}

TEST(Snu3Upu, LosesTwoTwistsAtHome) {
  const auto report = snu().check({"home"});
  EXPECT_EQ(report["verdict"], "singularity");
  const Rows rows = snu().matrix({{"x", 0}, {"y", 0}, {"z", 40}});
  // The lines of the legs meet at the height of the tip of their cone: a turn about it is free.
  const double tip = 40 * 30 / 20. - 40;
  for (const Row& twist : {Row{tip, 0, 0, 0, -1, 0}, Row{0, tip, 0, 1, 0, 0}})
    for (const Row& row : rows) {
      double rate = 0;
      for (std::size_t j = 0; j < 6; ++j) rate += row[j] * twist[j];
      EXPECT_NEAR(rate, 0, 1e-12);
    }
}

TEST(Snu3Upu, HasADeterminantThatIsZeroOnItsAxisAlone) {
  Poses poses;
  double constant_factor = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const double x = poses.between(-30, 30), y = poses.between(-30, 30), z = poses.between(5, 60);
    Rows rows = snu().matrix({{"x", x}, {"y", y}, {"z", z}});
    double lengths = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector<double> leg = Vector<double>{x, y, z} - 20. * outward(i);
      lengths *= norm(leg);
    }
    const double factor = approx_determinant(rows) * lengths / (z * z * (x * x + y * y));
    if (trial == 0) constant_factor = factor;
    EXPECT_NEAR(factor, constant_factor, 1e-9 * std::fabs(factor));
  }
}

// Hunt's robot.

const ShippedModel& hunt() {
  static const ShippedModel model("hunt_3rps");
  return model;
}

/// Along its motion the platform's joints stay in the planes of the legs, and its rows are the
/// derivatives of what each leg keeps or changes.
TEST(Hunt3Rps, HasTheDerivativesOfItsConstraintsAtPosesThatItCanHave) {
  Poses poses;
  const Motion& motion = hunt().model().motions.front();
  for (int trial = 0; trial < 20; ++trial) {
    const Point parameters{
        {"A", poses.between(0, 6.28)}, {"B", poses.between(0, 1.4)}, {"H", poses.between(15, 35)}};
    Point pose;
    for (std::size_t i = 0; i < 6; ++i)
      pose[hunt().model().pose[i].name] = evaluate(motion.pose[i], parameters);
    const auto at = [&](const Vector<double>& v) {
      return turned(2, pose["psi"], turned(0, pose["theta"], turned(2, pose["phi"], v)));
    };
    const Rows rows = hunt().matrix(pose);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector<double> r = at(10. * outward(i));
      const Vector<double> leg = position_of(pose) + r - 20. * outward(i);
      EXPECT_NEAR(dot(leg, tangent(i)), 0, 1e-12);
      const auto row = [&](const Vector<double>& force) {
        const Vector<double> moment = cross(r, force);
        return Row{force[0], force[1], force[2], moment[0], moment[1], moment[2]};
      };
      expect_equal(rows[i], row((1 / norm(leg)) * leg));
      expect_parallel(rows[3 + i], row(tangent(i)));
    }
  }
}

/// With the platform level the legs are at one angle to it; where they are level, they cannot lift.
TEST(Hunt3Rps, IsSingularWhereItsLegsAreInThePlatform) {
  EXPECT_EQ(hunt().verdict({"work"}), "no-singularity");
  EXPECT_EQ(hunt().verdict({"work", "--range", "B=0", "--range", "H=-1:1"}), "singularity");
  const Rows rows =
      hunt().matrix({{"x", 0}, {"y", 0}, {"z", 0}, {"psi", 0}, {"theta", 0}, {"phi", 0}});
  EXPECT_NEAR(approx_determinant(rows), 0, 1e-9);
}

// The active wrist.

TEST(ActiveWrist, HasTheRatesOfItsCarriages) {
  static const ShippedModel wrist("active_wrist");
  const Vector<double> base[] = {{12, 3, 0},    {-3.5, 12, 0},  {-8.5, 9, 0},
                                 {-8.5, -9, 0}, {-3.5, -12, 0}, {12, -3, 0}};
  const Vector<double> platform[] = {{6, 5, 0},     {1.5, 7.5, 0},  {-7.5, 3, 0},
                                     {-7.5, -3, 0}, {1.5, -7.5, 0}, {6, -5, 0}};
  Poses poses;
  for (int trial = 0; trial < 20; ++trial) {
    Point pose{{"x", poses.between(-2, 2)}, {"y", poses.between(-2, 2)}, {"z", 34}};
    for (const char* angle : {"roll", "pitch", "yaw"}) pose[angle] = poses.between(-0.2, 0.2);
    Point in_degrees = pose;
    for (const char* angle : {"roll", "pitch", "yaw"}) in_degrees[angle] /= kDegree;
    const Rows rows = wrist.matrix(in_degrees);
    for (std::size_t i = 0; i < 6; ++i)
      expect_equal(rows[i], derivatives(pose, [&](const MovingBody& body) {
                     const Vector<Dual> rod = body.at(platform[i]) - constant(base[i]);
                     const Dual drop = Dual{900} - rod[0] * rod[0] - rod[1] * rod[1];
                     return rod[2] - sqrt(drop);
                   }));
  }
}

}  // namespace
}  // namespace regulus::detail::test::legs_of_models
