// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the Gough family with a simple implementation in doubles that shares no code with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/mechanism/orientation.hpp"
#include "tests/support/evaluate.hpp"

namespace regulus::detail::gough_test {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Matrix times(const Matrix& A, const Matrix& B) {
  Matrix C{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
  return C;
}

Vector times(const Matrix& A, const Vector& v) {
  Vector w{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) w[i] += A[i][k] * v[k];
  return w;
}

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double norm(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Returns the rotation about an axis, by Rodrigues' formula.
Matrix about(const Vector& axis, double angle) {
  const double n = norm(axis);
  Matrix R{};
  if (n == 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Vector u = {axis[0] / n, axis[1] / n, axis[2] / n};
  for (std::size_t j = 0; j < 3; ++j) {
    Vector e{};
    e[j] = 1;
    const Vector ue = cross(u, e);
    for (std::size_t i = 0; i < 3; ++i)
      R[i][j] =
          std::cos(angle) * e[i] + std::sin(angle) * ue[i] + (1 - std::cos(angle)) * u[j] * u[i];
  }
  return R;
}

Matrix rotation(Orientation orientation, const test::Point& pose) {
  const Vector X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};
  const auto p = [&pose](const char* name) { return pose.at(name); };
  if (orientation == Orientation::kEulerZxz)
    return times(about(Z, p("psi")), times(about(X, p("theta")), about(Z, p("phi"))));
  if (orientation == Orientation::kRollPitchYaw)
    return times(about(Z, p("yaw")), times(about(Y, p("pitch")), about(X, p("roll"))));
  const Vector axis = {p("q1"), p("q2"), p("q3")};
  return about(axis, 2 * std::atan2(norm(axis), p("q0")));
}

const std::string kHead = "regulus = 1\nname = \"robot\"\n[gough]\n";

std::string word(Orientation orientation) {
  if (orientation == Orientation::kEulerZxz) return "euler-zxz";
  return orientation == Orientation::kQuaternion ? "quaternion" : "roll-pitch-yaw";
}

std::string motion(Orientation orientation) {
  std::string text = "[motion.here]\nx = 0\ny = 0\nz = 9\n";
  for (const std::string& name : orientation_names(orientation)) text += name + " = 0.5\n";
  return text;
}

class Robot {
 public:
  explicit Robot(Orientation orientation) : orientation_(orientation) {
    std::string text = kHead + "unit = \"cm\"\norientation = \"" + word(orientation) + "\"\n";
    for (const char* side : {"base", "platform"}) {
      text += std::string(side) + " = [";
      for (std::size_t i = 0; i < 6; ++i)
        text += "[" + std::to_string(integer()) + ", " + std::to_string(integer()) + ", " +
                std::to_string(integer()) + "], ";
      text += "]\n";
    }
    model_ = parse_model(text + motion(orientation), "robot.toml");
  }

  const Model& model() const { return model_; }

  test::Point random_pose() {
    test::Point pose;
    std::uniform_real_distribution<double> length(-20, 20), angle(-1.5, 1.5);
    for (std::size_t i = 0; i < model_.pose.size(); ++i)
      pose[model_.pose[i].name] = i < 3 ? length(random_) : angle(random_);
    for (const GeometryParameter& g : model_.geometry)
      pose[g.name] = GiNaC::ex_to<GiNaC::numeric>(g.value).to_double();
    return pose;
  }

  /// Returns the row (u, CB × u) of J⁻¹, u the unit vector of the leg, and the leg's length.
  std::pair<std::array<double, 6>, double> inverse_jacobian_row(std::size_t leg,
                                                                const test::Point& pose) const {
    const auto coordinates = [&](char side) {
      const std::string stem = std::string(1, side) + std::to_string(leg + 1);
      return Vector{pose.at(stem + "_x"), pose.at(stem + "_y"), pose.at(stem + "_z")};
    };
    const Vector a = coordinates('a');
    const Vector cb = times(rotation(orientation_, pose), coordinates('b'));
    Vector u = {pose.at("x") + cb[0] - a[0], pose.at("y") + cb[1] - a[1],
                pose.at("z") + cb[2] - a[2]};
    const double length = norm(u);
    for (double& component : u) component /= length;
    const Vector moment = cross(cb, u);
    return {{u[0], u[1], u[2], moment[0], moment[1], moment[2]}, length};
  }

 private:
  int integer() { return std::uniform_int_distribution<int>(-15, 15)(random_); }

  Orientation orientation_;
  std::mt19937_64 random_{42};
  Model model_;
};

class GoughModel : public testing::TestWithParam<Orientation> {};

TEST_P(GoughModel, RowScaleTimesMatrixIsTheInverseJacobian) {
  Robot robot(GetParam());
  for (int trial = 0; trial < 50; ++trial) {
    const test::Point pose = robot.random_pose();
    for (unsigned leg = 0; leg < 6; ++leg) {
      const double scale = test::evaluate(robot.model().row_scale[leg], pose);
      const auto [row, length] = robot.inverse_jacobian_row(leg, pose);
      for (unsigned j = 0; j < 6; ++j)
        EXPECT_NEAR(scale * test::evaluate(robot.model().matrix(leg, j), pose), row[j], 1e-11);
    }
  }
}

TEST_P(GoughModel, MatrixIsThePapersUpToTheNormOfAQuaternion) {
  Robot robot(GetParam());
  for (int trial = 0; trial < 50; ++trial) {
    const test::Point pose = robot.random_pose();
    double scale = 1;
    if (GetParam() == Orientation::kQuaternion)
      scale = std::pow(pose.at("q0"), 2) + std::pow(pose.at("q1"), 2) + std::pow(pose.at("q2"), 2) +
              std::pow(pose.at("q3"), 2);
    for (unsigned leg = 0; leg < 6; ++leg) {
      const auto [row, length] = robot.inverse_jacobian_row(leg, pose);
      for (unsigned j = 0; j < 6; ++j)
        EXPECT_NEAR(test::evaluate(robot.model().matrix(leg, j), pose), scale * length * row[j],
                    1e-9);
    }
  }
}

TEST_P(GoughModel, HasSymbolicAnchorsOfBothGroups) {
  const Robot robot(GetParam());
  const Model& model = robot.model();
  ASSERT_EQ(model.geometry.size(), 36U);
  EXPECT_EQ(model.geometry[0].name, "a1_x");
  EXPECT_EQ(model.geometry[17].name, "a6_z");
  EXPECT_EQ(model.geometry[18].name, "b1_x");
  EXPECT_EQ(model.geometry[35].name, "b6_z");
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_EQ(model.geometry[i].group, i < 18 ? "base" : "platform");
    EXPECT_TRUE(model.geometry[i].tolerance.is_zero());
    bool used = false;
    for (unsigned j = 0; j < 6; ++j)
      used =
          used || model.matrix(static_cast<unsigned>(i % 18 / 3), j).has(model.geometry[i].symbol);
    EXPECT_TRUE(used) << model.geometry[i].name;
  }
}

std::string word_of(Orientation orientation) {
  if (orientation == Orientation::kEulerZxz) return "EulerZxz";
  return orientation == Orientation::kQuaternion ? "Quaternion" : "RollPitchYaw";
}

INSTANTIATE_TEST_SUITE_P(Orientations, GoughModel,
                         testing::Values(Orientation::kEulerZxz, Orientation::kRollPitchYaw,
                                         Orientation::kQuaternion),
                         [](const auto& orientation) { return word_of(orientation.param); });

std::vector<std::string> pose_names(Orientation orientation) {
  std::vector<std::string> names;
  const Robot robot(orientation);
  for (const PoseParameter& p : robot.model().pose) names.push_back(p.name + ":" + p.unit);
  return names;
}

TEST(GoughPose, IsInTheOrderOfTheTwistWithUnits) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(pose_names(Orientation::kEulerZxz),
            (Names{"x:cm", "y:cm", "z:cm", "psi:rad", "theta:rad", "phi:rad"}));
  EXPECT_EQ(pose_names(Orientation::kRollPitchYaw),
            (Names{"x:cm", "y:cm", "z:cm", "roll:rad", "pitch:rad", "yaw:rad"}));
  EXPECT_EQ(pose_names(Orientation::kQuaternion),
            (Names{"x:cm", "y:cm", "z:cm", "q0:1", "q1:1", "q2:1", "q3:1"}));
}

TEST(GoughQuaternion, IsUndefinedAtZeroOnly) {
  const Robot robot(Orientation::kQuaternion);
  ASSERT_EQ(robot.model().must_be_defined.size(), 1U);
  const GiNaC::ex condition = robot.model().must_be_defined[0];
  EXPECT_TRUE(std::isnan(test::evaluate(condition, {{"q0", 0}, {"q1", 0}, {"q2", 0}, {"q3", 0}})));
  EXPECT_FALSE(
      std::isnan(test::evaluate(condition, {{"q0", 0}, {"q1", 1e-3}, {"q2", 0}, {"q3", 0}})));
}

const std::string kAnchors = "[[1, 0, 0], [2, 0, 0], [3, 0, 1], [4, 1, 0], [5, 0, 2], [6, 0, 3]]";

Model with_keys(const std::string& keys) {
  return parse_model(kHead + "orientation = \"euler-zxz\"\nbase = " + kAnchors +
                         "\nplatform = " + kAnchors + "\n" + keys + motion(Orientation::kEulerZxz),
                     "robot.toml");
}

TEST(GoughTolerance, BallsHoldTheThreeCoordinatesOfAnAnchor) {
  const Model model = with_keys("base_tolerance = 0.05\ntolerance_shape = \"ball\"\n");
  ASSERT_EQ(model.balls.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(model.balls[i].members, (std::vector<std::size_t>{3 * i, 3 * i + 1, 3 * i + 2}));
    EXPECT_TRUE(model.balls[i].radius.is_equal(i < 6 ? GiNaC::ex(GiNaC::numeric(1, 20)) : 0));
    for (const std::size_t member : model.balls[i].members) {
      EXPECT_EQ(model.geometry[member].ball, static_cast<int>(i));
      EXPECT_TRUE(model.geometry[member].tolerance.is_equal(model.balls[i].radius));
    }
  }
}

TEST(GoughTolerance, BoxesHaveNoBalls) {
  const Model model = with_keys("platform_tolerance = 1\n");
  EXPECT_TRUE(model.balls.empty());
  EXPECT_EQ(model.geometry[0].ball, -1);
  EXPECT_TRUE(model.geometry[0].tolerance.is_zero());
  EXPECT_TRUE(model.geometry[35].tolerance.is_equal(1));
}

/// An anchor with a tolerance or a radius has these, and the others have those of their side.
TEST(GoughTolerance, MayBeThatOfOneAnchor) {
  for (const bool are_balls : {false, true}) {
    std::string text =
        kHead + "orientation = \"euler-zxz\"\nbase_tolerance = 0.1\nbase = " + kAnchors +
        "\nplatform = " + kAnchors + "\n" + (are_balls ? "tolerance_shape = \"ball\"\n" : "") +
        motion(Orientation::kEulerZxz);
    const auto replace = [&text](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("[2, 0, 0]", "{ value = [2, 0, 0], tolerance = 0.2 }");
    replace("[3, 0, 1]", "{ value = [3, 0, 1], radius = 0.3 }");
    replace("[4, 1, 0]", "{ value = [4, 1, 0] }");
    const Model model = parse_model(text, "robot.toml");
    for (std::size_t i = 0; i < 18; ++i) {
      const GeometryParameter& g = model.geometry[i];
      const std::size_t leg = i / 3 + 1;
      const long tenths = leg == 2 ? 2 : leg == 3 ? 3 : 1;
      EXPECT_TRUE(g.tolerance.is_equal(GiNaC::numeric(tenths, 10))) << g.name;
      EXPECT_EQ(g.ball >= 0, leg == 3 || (are_balls && leg != 2)) << g.name;
      EXPECT_EQ(g.group, "base");
    }
    EXPECT_EQ(model.balls.size(), are_balls ? 11U : 1U);
  }
}

}  // namespace
}  // namespace regulus::detail::gough_test
