// SPDX-License-Identifier: GPL-3.0-or-later
// Models made of MJCF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "tests/support/robots/robot_file.hpp"
#include "tests/support/serial/model_twists.hpp"

namespace regulus::detail::test::mjcf {
namespace {

using testing::HasSubstr;

Imported imported(const std::string& text, const ImportOptions& options = {}) {
  return import_robot(text, "arm.xml", options);
}

const std::string kArm = robot_text("arm.mjcf");

ChainJoint turning(const Frame& origin, const Vec& axis) {
  return {.origin = origin, .axis = axis};
}

TEST(Mjcf, HasTheTwistsOfItsBodies) {
  const double quarter = std::numbers::pi / 2;
  const auto at = [](const Vec& p) { return Frame{.p = p}; };
  const std::vector<ChainJoint> chain = {
      turning({turn_about({0, 0, 1}, quarter), {0, 0, 0.1}}, {0, 0, 1}),
      turning(at({0, 0, 0.25}), {0, 1, 0}),
      turning(at({0, 0, -0.05}) * Frame{turn_about({0, 1, 0}, quarter), {0.3, 0, 0}}, {0, 1, 0}),
      turning(at({0.25, 0.02, 0}), {1, 0, 0}),
      turning(at({0.1, 0, 0}), {0, 1, 0}),
      turning(at({-0.1, 0, 0.01}) * at({0.1, 0, 0}), {1, 0, 0})};
  const Model model = parse_model(imported(kArm).model, "imported.toml");
  ASSERT_EQ(model.pose.size(), 6U);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> between(-3, 3);
  for (int pose = 0; pose < 100; ++pose) {
    std::vector<double> q(6);
    for (double& x : q) x = between(random);
    expect_same_arm(model_twists(model, q), difference_twists(chain, q));
  }
}

TEST(Mjcf, TakesRangesFromDefaultClasses) {
  const std::string model = imported(kArm).model;
  EXPECT_THAT(model, HasSubstr("pan = [\"-pi\", \"pi\"]"));
  EXPECT_THAT(model, HasSubstr("lift = [\"-pi/2\", \"pi/2\"]"));
  EXPECT_THAT(model, HasSubstr("elbow = [0, \"5*pi/6\"]"));
  EXPECT_THAT(model, HasSubstr("turn = [\"-170*deg\", \"170*deg\"]"));
}

TEST(Mjcf, ReportsQuaternionsThatBecomeAngles) {
  EXPECT_THAT(imported(kArm).report(),
              HasSubstr("quat of body 'lower': 0.707107 0 0.707107 0 -> rpy [0, pi/2, 0]"));
}

std::string hinge_behind(const std::string& orientation) {
  return "<mujoco><compiler angle='radian'/><worldbody><body name='a'><joint name='i'/>"
         "<body name='b' pos='1 0 0' " +
         orientation +
         "><joint name='j' axis='0 1 0'/><body name='c' pos='0 0 1'><joint name='k' axis='1 0 1'/>"
         "<body name='d' pos='0.2 0.3 0'><joint name='l' axis='0 1 2'/></body></body></body></body>"
         "</worldbody></mujoco>";
}

void expect_turn(const std::string& orientation, const Mat& R) {
  const Model model = parse_model(imported(hinge_behind(orientation)).model, "imported.toml");
  const std::vector<ChainJoint> chain = {turning({}, {0, 0, 1}), turning({R, {1, 0, 0}}, {0, 1, 0}),
                                         turning({.p = {0, 0, 1}}, {1, 0, 1}),
                                         turning({.p = {0.2, 0.3, 0}}, {0, 1, 2})};
  const std::vector<double> q = {0.3, -0.8, 0.5, 0.2};
  ASSERT_EQ(kept_rows(model).size(), 6U);
  SCOPED_TRACE(orientation);
  expect_same_arm(model_twists(model, q), difference_twists(chain, q));
}

TEST(Mjcf, ReadsEveryKindOfOrientation) {
  const auto x = [](double a) { return turn_about({1, 0, 0}, a); };
  const auto y = [](double a) { return turn_about({0, 1, 0}, a); };
  const auto z = [](double a) { return turn_about({0, 0, 1}, a); };
  expect_turn("euler='0.1 0.2 0.3'", x(0.1) * (y(0.2) * z(0.3)));
  expect_turn("axisangle='1 2 3 0.7'", turn_about({1, 2, 3}, 0.7));
  expect_turn("axisangle='0 -2 0 0.7'", y(-0.7));
  expect_turn("xyaxes='0 1 0 -1 0 0'", z(std::numbers::pi / 2));
  expect_turn("xyaxes='1 1 0 -1 1 0.5'",
              z(std::numbers::pi / 4) * x(std::atan2(0.5, std::sqrt(2.0))));
  expect_turn("zaxis='0 1 1'", x(-std::numbers::pi / 4));
  expect_turn("zaxis='0 0 -1'", x(std::numbers::pi));
  expect_turn("quat='1 2 3 4'", turn_about({2, 3, 4}, 2 * std::atan2(std::sqrt(29.0), 1)));
}

/// Files that a converter wrote with six digits.
TEST(Mjcf, NamesQuaternionsThatAreNearlyTurnsOfACube) {
  const struct {
    const char *quat, *note, *snap, *orientation;
  } kCases[] = {
      {"0.707105 0 0 -0.707108", "is not rpy [0, 0, -pi/2]; if it is meant, --snap 1e-5", "1e-5",
       "rpy = [0, 0, \"-pi/2\"]"},
      {"0.499998 0.5 -0.500002 -0.5",
       "is not quaternion [1, 1, -1, -1]; if it is meant, --snap 1e-5", "1e-5",
       "quaternion = [1, 1, -1, -1]"},
      {"-2.59734e-06 -0.707105 -0.707108 -2.59735e-06",
       "is not quaternion [0, -1, -1, 0]; if it is meant, --snap 1e-5", "1e-5",
       "quaternion = [0, -1, -1, 0]"},
      {"0.499898 -0.500102 -0.5 -0.5",
       "is not quaternion [1, -1, -1, -1]; if it is meant, --snap 1e-3", "1e-3",
       "quaternion = [1, -1, -1, -1]"},
  };
  for (const auto& one : kCases) {
    const std::string text = hinge_behind("quat='" + std::string(one.quat) + "'");
    EXPECT_THAT(imported(text).report(), HasSubstr(one.note));
    EXPECT_THAT(imported(text, {.snap = one.snap}).model, HasSubstr(one.orientation));
    EXPECT_THAT(imported(text, {.snap = one.snap}).report(), HasSubstr(one.quat));
  }
}

std::string followed(const std::string& equality) {
  return "<mujoco><worldbody><body name='a'><joint name='i'/><body name='b' pos='1 0 0'><joint "
         "name='j' axis='0 1 0'/><body name='c' pos='0 0 1'><joint name='k'/></body></body></body>"
         "</worldbody><equality>" +
         equality + "</equality></mujoco>";
}

TEST(Mjcf, ReadsJointsThatFollowByALine) {
  EXPECT_THAT(imported(followed("<joint joint1='j' joint2='i' polycoef='0.1 -2 0 0 0'/>")).model,
              HasSubstr("{ mimic = \"i\", multiplier = -2, offset = 0.1, xyz = [1, 0, 0]"));
  EXPECT_THAT(imported(followed("<joint joint1='j' joint2='k'/>")).model,
              HasSubstr("{ mimic = \"k\", xyz = [1, 0, 0]"));
  for (const char* other : {"joint2='i' polycoef='0 1 0.5 0 0'", "polycoef='1 0 0 0 0'"})
    EXPECT_THROW(
        static_cast<void>(imported(followed("<joint joint1='j' " + std::string(other) + "/>"))),
        std::runtime_error);
}

TEST(Mjcf, LeavesExactTurnsOfACubeAsTheyAre) {
  const std::string text = hinge_behind("quat='0.5 -0.5 0.5 0.5'");
  EXPECT_THAT(imported(text).model, HasSubstr("quaternion = [0.5, -0.5, 0.5, 0.5]"));
  EXPECT_THAT(imported(text).report(), testing::Not(HasSubstr("snapped")));
}

}  // namespace
}  // namespace regulus::detail::test::mjcf
