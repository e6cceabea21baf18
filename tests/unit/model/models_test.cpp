// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the models that come with Regulus.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "tests/support/evaluate.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::Pi;

Model shipped(const std::string& name) {
  return load_model(std::string(REGULUS_SOURCE_DIR) + "/models/" + name + ".toml");
}

std::vector<std::string> motion_names(const Model& model) {
  std::vector<std::string> names;
  for (const Motion& motion : model.motions) names.push_back(motion.name);
  return names;
}

/// Table III: rows of x_A y_A z_A x_B y_B z_B.
using TableIII = std::array<std::array<int, 6>, 6>;
constexpr TableIII kRobot1 = {{{-9, 9, 0, -3, 7, 0},
                               {9, 9, 0, 3, 7, 0},
                               {12, -3, 0, 7, -1, 0},
                               {3, -13, 0, 4, -6, 0},
                               {-3, -13, 0, -4, -6, 0},
                               {-12, -3, 0, -7, -1, 0}}};
constexpr TableIII kRobot2 = {{{-2539, 1778, 0, -657, -239, -100},
                               {2539, 1778, 500, 657, -239, 100},
                               {2809, 1310, 0, 121, 689, -100},
                               {270, -3088, 500, -536, -449, 100},
                               {-270, -3088, 0, 536, -449, -100},
                               {-2809, 1310, 500, -121, 689, 100}}};

void expect_anchors(const Model& model, const TableIII& table) {
  ASSERT_EQ(model.geometry.size(), 36U);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(model.geometry[3 * i + axis].value.is_equal(table[i][axis]));
      EXPECT_TRUE(model.geometry[18 + 3 * i + axis].value.is_equal(table[i][3 + axis]));
    }
}

void expect_box(const Model& model, const std::string& name, int xy, int z_lo, int z_hi,
                int degrees) {
  const Motion& motion = find_motion(model, name);
  ASSERT_EQ(motion.parameters.size(), 6U) << name;
  const ex angle = degrees * Pi / 180;
  const std::array<ex, 6> lo = {-xy, -xy, z_lo, -angle, -angle, -angle};
  const std::array<ex, 6> hi = {xy, xy, z_hi, angle, angle, angle};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(motion.parameters[i].range.lo.is_equal(lo[i])) << name;
    EXPECT_TRUE(motion.parameters[i].range.hi.is_equal(hi[i])) << name;
  }
}

TEST(Robot1, HasTheAnchorsOfTableIII) { expect_anchors(shipped("robot_1"), kRobot1); }
TEST(Robot2, HasTheAnchorsOfTableIII) { expect_anchors(shipped("robot_2"), kRobot2); }

TEST(Robot1, HasTheMotionsOfThePaper) {
  const Model model = shipped("robot_1");
  EXPECT_EQ(motion_names(model),
            (std::vector<std::string>{"table4_1", "table4_2", "table4_5", "wide_15", "wide_40",
                                      "table6_5_5", "table6_5_15", "table6_15_15", "T1", "T2",
                                      "T1_errors", "T2_errors"}));
  expect_box(model, "table4_1", 5, 45, 50, 1);
  expect_box(model, "table4_2", 5, 45, 50, 2);
  expect_box(model, "table4_5", 5, 45, 50, 5);
  expect_box(model, "wide_15", 15, 45, 50, 15);
  expect_box(model, "wide_40", 15, 45, 50, 40);
  expect_box(model, "table6_5_5", 5, 45, 50, 5);
  expect_box(model, "table6_5_15", 5, 45, 50, 15);
  expect_box(model, "table6_15_15", 15, 45, 50, 15);
}

TEST(Robot2, HasTheMotionsOfThePaper) {
  const Model model = shipped("robot_2");
  EXPECT_EQ(motion_names(model), (std::vector<std::string>{"table5_20", "table5_30", "table5_40"}));
  expect_box(model, "table5_20", 200, 2800, 3200, 20);
  expect_box(model, "table5_30", 200, 2800, 3200, 30);
  expect_box(model, "table5_40", 200, 2800, 3200, 40);
}

TEST(Robot1, FollowsTheTrajectoriesOfThePaper) {
  const Model model = shipped("robot_1");
  for (const char* name : {"T1", "T1_errors", "T2", "T2_errors"}) {
    const Motion& motion = find_motion(model, name);
    ASSERT_EQ(motion.parameters.size(), 1U);
    const ex t = 2 * Pi * motion.parameters[0].symbol;
    const bool turns = name[1] == '2';
    const std::array<ex, 6> expected = {8 * cos(t),    8 * sin(t),          55,
                                        turns ? t : 0, turns ? Pi / 36 : 0, turns ? ex(-t) : ex(0)};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(motion.pose[i].is_equal(expected[i])) << name;
  }
}

TEST(Robot1, HasTheControlErrorsOfTableVII) {
  const Model model = shipped("robot_1");
  for (const char* name : {"T1", "T2"})
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_TRUE(find_motion(model, name).error[i].is_zero());
      EXPECT_TRUE(find_motion(model, std::string(name) + "_errors")
                      .error[i]
                      .is_equal(numeric(1, i < 3 ? 100 : 1000)));
    }
}

TEST(Rump, HasItsExactValue) {
  const Model model = shipped("rump");
  const Motion& motion = find_motion(model);
  GiNaC::exmap at;
  for (const MotionParameter& p : motion.parameters) {
    EXPECT_TRUE(p.range.lo.is_equal(p.range.hi));
    at[p.symbol] = p.range.lo;
  }
  EXPECT_TRUE(model.matrix(0, 0).subs(at).is_equal(numeric(-54767, 66192)));
}

class Planar : public testing::Test {
 protected:
  /// Returns det J⁻¹, including the row scales.
  double determinant(double x, double y, double phi) const {
    test::Point point = {{"x", x}, {"y", y}, {"phi", phi}};
    for (const GeometryParameter& g : model_.geometry) point[g.name] = test::evaluate(g.value, {});
    std::array<std::array<double, 3>, 3> a{};
    for (unsigned i = 0; i < 3; ++i) {
      const double scale = test::evaluate(model_.row_scale[i], point);
      for (unsigned j = 0; j < 3; ++j) a[i][j] = scale * test::evaluate(model_.matrix(i, j), point);
    }
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  }

  /// Returns the least and the greatest determinant on a grid over the motion's box.
  std::pair<double, double> extremes(const std::string& name) const {
    const Motion& motion = find_motion(model_, name);
    const auto at = [&motion](std::size_t i, int step) {
      const double lo = test::evaluate(motion.parameters[i].range.lo, {});
      const double hi = test::evaluate(motion.parameters[i].range.hi, {});
      return lo + (hi - lo) * step / 8;
    };
    std::pair<double, double> found = {1e300, -1e300};
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j)
        for (int k = 0; k <= 8; ++k) {
          const double det = determinant(at(0, i), at(1, j), at(2, k));
          found = {std::min(found.first, det), std::max(found.second, det)};
        }
    return found;
  }

  Model model_ = shipped("planar_3rpr");
};

TEST_F(Planar, TriangleHasThePublishedSides) {
  // The law of cosines gives the coordinates of B2 and B3 in the mobile frame.
  const double u3 = (17.04 * 17.04 + 20.84 * 20.84 - 16.54 * 16.54) / (2 * 17.04);
  const double v3 = std::sqrt(20.84 * 20.84 - u3 * u3);
  EXPECT_NEAR(std::hypot(17.04 - u3, v3), 16.54, 1e-12);
  test::Point point = {{"x", 0}, {"y", 0}, {"phi", 0}};
  for (const GeometryParameter& g : model_.geometry) point[g.name] = test::evaluate(g.value, {});
  EXPECT_NEAR(test::evaluate(model_.matrix(1, 0), point), 17.04 - 15.91, 1e-12);
  EXPECT_NEAR(test::evaluate(model_.matrix(2, 0), point), u3, 1e-12);
  EXPECT_NEAR(test::evaluate(model_.matrix(2, 1), point), v3 - 10, 1e-12);
}

TEST_F(Planar, MatrixGivesTheRatesOfTheLegLengths) {
  const auto lengths = [this](double x, double y, double phi) {
    test::Point point = {{"x", x}, {"y", y}, {"phi", phi}};
    for (const GeometryParameter& g : model_.geometry) point[g.name] = test::evaluate(g.value, {});
    std::array<double, 3> rho{};
    for (unsigned i = 0; i < 3; ++i) rho[i] = 1 / test::evaluate(model_.row_scale[i], point);
    return rho;
  };
  test::Point point = {{"x", 2}, {"y", 15}, {"phi", 0.3}};
  for (const GeometryParameter& g : model_.geometry) point[g.name] = test::evaluate(g.value, {});
  const double step = 1e-6;
  for (unsigned j = 0; j < 3; ++j) {
    const auto forward = lengths(2 + (j == 0) * step, 15 + (j == 1) * step, 0.3 + (j == 2) * step);
    const auto backward = lengths(2 - (j == 0) * step, 15 - (j == 1) * step, 0.3 - (j == 2) * step);
    for (unsigned i = 0; i < 3; ++i)
      EXPECT_NEAR(test::evaluate(model_.row_scale[i] * model_.matrix(i, j), point),
                  (forward[i] - backward[i]) / (2 * step), 1e-7);
  }
}

TEST_F(Planar, RegularMotionStaysOnOneSide) {
  EXPECT_GT(extremes("regular").first, 1);
  EXPECT_GT(extremes("reach").first, 1);
}

TEST_F(Planar, CrossingMotionChangesSides) {
  const auto [least, greatest] = extremes("crossing");
  EXPECT_LT(least, -1);
  EXPECT_GT(greatest, 1);
}

}  // namespace
}  // namespace regulus::detail
