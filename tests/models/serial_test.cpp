// SPDX-License-Identifier: GPL-3.0-or-later
// Arms by their joints: the twin of one with a written matrix, and their known singular poses.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::test {
namespace {

Point joints(Poses& poses, const Model& model) {
  Point point;
  for (const PoseParameter& p : model.pose) point[p.name] = poses.between(-3, 3);
  return point;
}

TEST(SerialArms, HaveTheDeterminantOfTheirTwin) {
  const ShippedModel twin("puma_560"), arm("puma_560_serial");
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    const Point point = joints(poses, arm.model());
    EXPECT_NEAR(std::fabs(approx_determinant(arm.matrix(point))),
                std::fabs(approx_determinant(twin.matrix(point))), 1e-14);
  }
}

TEST(SerialArms, HaveTheVerdictsOfTheirTwin) {
  const ShippedModel twin("puma_560"), arm("puma_560_serial");
  for (const Motion& motion : twin.model().motions)
    EXPECT_EQ(arm.verdict({motion.name}), twin.verdict({motion.name})) << motion.name;
}

TEST(SerialArms, SayInTheirClaimWhichMatrixTheyMean) {
  const ShippedModel arm("puma_560_serial");
  const auto report = arm.check({"dexterous"});
  EXPECT_EQ(report["claim"],
            "the full 6×6 forward Jacobian has full rank for every pose of the variety");
  EXPECT_EQ(report["matrix"], "forward Jacobian");
  EXPECT_EQ(report["matrix_notes"].back(), "its rank does not depend on q1, q4, q6");
}

/// Of the arm with three parallel axes: elbow, wrist, shoulder.
TEST(SerialArms, HaveTheFactorsOfThreeParallelAxes) {
  const ShippedModel arm("three_parallel_axes");
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    const Point q = joints(poses, arm.model());
    const double q2 = q.at("q2"), q23 = q2 + q.at("q3"), q234 = q23 + q.at("q4");
    const double shoulder = 0.42 * std::cos(q2) + 0.39 * std::cos(q23) - 0.1 * std::sin(q234);
    EXPECT_NEAR(std::fabs(approx_determinant(arm.matrix(q))),
                std::fabs(0.42 * 0.39 * std::sin(q.at("q3")) * std::sin(q.at("q5")) * shoulder),
                1e-14);
  }
}

TEST(SerialArms, AreSingularExactlyAtElbowAndShoulder) {
  const ShippedModel arm("three_parallel_axes");
  const Paving paving(arm,
                      {"elbow", "--range", "q2=-170*deg:-20*deg", "--range", "q3=-50*deg:130*deg",
                       "--resolution", "1/32"},
                      "q2", "q3");
  paving.expect_to_agree_with([](double q2, double q3) {
    return std::sin(q3) * (0.42 * std::cos(q2) + 0.39 * std::cos(q2 + q3) -
                           0.1 * std::sin(q2 + q3 - std::acos(-1.0) / 2));
  });
  EXPECT_GT(paving.count("singular"), 30U);
  EXPECT_GT(paving.fraction("free"), 0.8);
}

}  // namespace
}  // namespace regulus::test
