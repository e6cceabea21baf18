// SPDX-License-Identifier: GPL-3.0-or-later
// Eight cables for six degrees of freedom: the matrix has more rows than columns.
#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"

namespace regulus::detail::test::cable_8 {
namespace {

const ShippedModel& robot() {
  static const ShippedModel model("cable_8");
  return model;
}

/// Two cables start at each corner of the hall. One crosses the box in x to its lower edge, the
/// other in y to its upper edge.
struct Cable {
  Vector<double> pulley, eye;
};
Cable cable(int k) {
  const double sx = k / 2 == 0 || k / 2 == 3 ? -1 : 1, sy = k / 2 < 2 ? -1 : 1;
  const double crossing_x = k % 2 == 0 ? -1 : 1;
  return {{5.5 * sx, 4.5 * sy, 8},
          {0.5 * sx * crossing_x, -0.5 * sy * crossing_x, k % 2 == 0 ? -0.5 : 0.5}};
}

TEST(Cable8, HasTheDerivativesOfTheCablesLengths) {
  Poses poses;
  for (int trial = 0; trial < 10; ++trial) {
    const Point pose{{"x", poses.between(-3, 3)},     {"y", poses.between(-3, 3)},
                     {"z", poses.between(1, 6)},      {"roll", poses.between(-1, 1)},
                     {"pitch", poses.between(-1, 1)}, {"yaw", poses.between(-1, 1)}};
    const Rows rows = robot().matrix(pose);
    ASSERT_EQ(rows.size(), 8U);
    for (int k = 0; k < 8; ++k)
      expect_parallel(rows[std::size_t(k)], derivatives(pose, [k](const MovingBody& body) {
                        return norm(body.at(cable(k).eye) - constant(cable(k).pulley));
                      }));
  }
}

/// Returns det MᵀM, the sum of the squares of all 6×6 minors.
double gram(double x, double z) {
  const Rows rows =
      robot().matrix({{"x", x}, {"y", 0.7}, {"z", z}, {"roll", 0}, {"pitch", 0}, {"yaw", 0}});
  Rows product(6, Row(6));
  for (const Row& row : rows)
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) product[i][j] += row[i] * row[j];
  return approx_determinant(product);
}

TEST(Cable8, LosesItsRankOnALine) {
  EXPECT_NEAR(gram(0, 2.5) / gram(1, 4), 0, 1e-12);
  EXPECT_GT(gram(0.01, 2.5) / gram(1, 4), 1e-8);
  const auto report = robot().check({"low", "--max-boxes", "3000"});
  EXPECT_EQ(report["verdict"], "singularity");
  const auto& point = report["witness"]["points"][0];
  EXPECT_EQ(point["pose"]["z"], (std::vector<double>{2.5, 2.5}));
  EXPECT_EQ(point["pose"]["x"], (std::vector<double>{0, 0}));
  EXPECT_TRUE(point["determinant"].is_null());
  EXPECT_EQ(robot().verdict({"low", "--range", "x=1e-7:1", "--max-boxes", "3000"}),
            "no-singularity");
}

TEST(Cable8, IsCertifiedFreeAllButAroundThatLine) {
  const Paving paving(robot(),
                      {"low", "--range", "x=-2:2.3", "--range", "z=1:5", "--range", "y=0.7",
                       "--resolution", "1/32"},
                      "x", "z");
  EXPECT_EQ(paving.count("singular"), 0U);
  EXPECT_GT(paving.fraction("free"), 0.98);
  EXPECT_FALSE(paving.is_free(0, 2.5));
  EXPECT_TRUE(paving.is_free(0, 3.5));
}

TEST(Cable8, HasFullColumnRankWhereItWorks) {
  EXPECT_EQ(robot().check({"work"})["claim"],
            "the full 8×6 matrix has full rank for every pose of the motion");
  EXPECT_EQ(robot().verdict({"descent"}), "no-singularity");
}

}  // namespace
}  // namespace regulus::detail::test::cable_8
