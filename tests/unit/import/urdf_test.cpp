// SPDX-License-Identifier: GPL-3.0-or-later
// Models made of URDF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/robots/robot_file.hpp"
#include "tests/support/serial/model_twists.hpp"

namespace regulus::detail::test::urdf {
namespace {

using testing::HasSubstr;
using testing::Not;

Imported imported(const std::string& text, const ImportOptions& options = {}) {
  return import_robot(text, "arm.urdf", options);
}

Model model_of(const std::string& text, const ImportOptions& options = {}) {
  return parse_model(imported(text, options).model, "imported.toml");
}

class Arm : public testing::TestWithParam<std::string> {};

/// Snapped numbers differ by less than 1e-9, so the twists do by little more.
TEST_P(Arm, HasTheTwistsOfItsFile) {
  const std::string text = robot_text(GetParam() + ".urdf");
  const Model model = model_of(text);
  const std::vector<ChainJoint> chain = urdf_chain(text);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> between(-std::numbers::pi, std::numbers::pi);
  for (int pose = 0; pose < 100; ++pose) {
    std::vector<double> q(model.pose.size());
    for (double& x : q) x = between(random);
    expect_same_arm(model_twists(model, q), difference_twists(chain, q));
  }
}

TEST_P(Arm, HasItsRangesAndItsDigest) {
  const Imported arm = imported(robot_text(GetParam() + ".urdf"));
  const Model model = parse_model(arm.model, "imported.toml");
  ASSERT_FALSE(model.motions.empty());
  EXPECT_EQ(model.motions[0].name, "limits");
  EXPECT_EQ(model.motions[0].parameters.size(), model.pose.size());
  EXPECT_THAT(model.source, HasSubstr("SHA-256 "));
  EXPECT_THAT(arm.report(), HasSubstr("rank does not depend on"));
}

INSTANTIATE_TEST_SUITE_P(Urdf, Arm, testing::ValuesIn(arm_names()),
                         [](const auto& arm) { return arm.param; });

/// Two joints, of which the second has this text.
std::string arm_with(const std::string& joint) {
  return "<robot name='two'><link name='a'/><link name='b'/><link name='c'/>\n"
         "<joint name='first' type='revolute'><parent link='a'/><child link='b'/>"
         "<axis xyz='0 0 1'/><limit lower='-1' upper='1'/></joint>\n" +
         joint + "</robot>";
}

std::string second(const std::string& inside, const std::string& type = "revolute",
                   const std::string& name = "second") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='b'/><child link='c'/>" +
         inside + "</joint>";
}

TEST(Urdf, SnapsAndSaysSo) {
  const std::string text =
      arm_with(second("<origin xyz='0.33299999999999996 1e-17 0' rpy='1.570796326794897 0 0'/>"
                      "<axis xyz='0 1 0'/><limit lower='-2.96705972839' upper='0.1'/>"));
  const Imported snapped = imported(text);
  EXPECT_THAT(snapped.model, HasSubstr("xyz = [0.333, 0, 0], rpy = [\"pi/2\", 0, 0]"));
  EXPECT_THAT(snapped.model, HasSubstr("second = [\"-170*deg\", 0.1]"));
  EXPECT_THAT(snapped.report(),
              HasSubstr("line 3, rpy of joint 'second': 1.570796326794897 -> pi/2"));
  EXPECT_THAT(snapped.report(), HasSubstr("0.33299999999999996 -> 0.333"));
  const Imported exact = imported(text, {.snap = "0"});
  EXPECT_THAT(exact.model, HasSubstr("\"0.33299999999999996\", \"0.00000000000000001\", 0"));
  EXPECT_THAT(exact.model, HasSubstr("\"1.570796326794897\""));
  EXPECT_THAT(exact.report(), Not(HasSubstr("snapped")));
}

TEST(Urdf, WritesTurnsByOtherAnglesAsAQuaternion) {
  const std::string text =
      arm_with(second("<origin xyz='1 0 0' rpy='0.1 -0.2 0.3'/><axis xyz='0 1 0'/>"));
  EXPECT_THAT(imported(text).report(),
              HasSubstr("rpy of joint 'second': 0.1 -0.2 0.3 -> quaternion"));
  const Model snapped = model_of(text), exact = model_of(text, {.snap = "0"});
  const std::vector<double> q = {0.4, 0.5};
  expect_same_arm(model_twists(snapped, q), model_twists(exact, q), 1e-10);
}

TEST(Urdf, TakesOneTurnWhereLimitsAreMissing) {
  const Imported arm = imported(arm_with(second("<axis xyz='0 1 0'/>")));
  EXPECT_THAT(arm.model, HasSubstr("second = [\"-pi\", \"pi\"] # assumed: the file has none"));
  EXPECT_THAT(arm.report(), HasSubstr("joint 'second' has no limits: one turn is assumed"));
  EXPECT_THAT(imported(arm_with(second("<axis xyz='0 1 0'/>", "continuous"))).model,
              HasSubstr("second = [\"-pi\", \"pi\"] # turns without end"));
}

/// a, then 'lead' and a joint that follows it.
std::string follower_arm(const std::string& leader, const std::string& follower,
                         const std::string& inside, const std::string& limits = {}) {
  return "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><joint name='lead' "
         "type='" +
         leader + "'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>" + limits +
         "</joint>\n<joint name='back' type='" + follower +
         "'><parent link='b'/><child link='c'/><axis xyz='0 1 0'/><origin xyz='1 0 0'/>" +
         "<mimic joint='lead' " + inside + "</joint></robot>";
}

TEST(Urdf, CountsTheTurnsAfterWhichAFollowerRepeats) {
  EXPECT_THAT(
      imported(follower_arm("continuous", "continuous", "multiplier='0.5'/>")).model,
      HasSubstr("lead = [\"-2*pi\", \"2*pi\"] # turns without end: those that follow repeat "
                "after 2 turns"));
  EXPECT_THAT(imported(follower_arm("continuous", "continuous", "multiplier='-3'/>")).model,
              HasSubstr("lead = [\"-pi\", \"pi\"] # turns without end\n"));
  const Imported never = imported(follower_arm("continuous", "prismatic", "multiplier='0.1'/>"));
  EXPECT_THAT(never.model, HasSubstr("# assumed: one turn of a joint that turns without end"));
  EXPECT_THAT(never.report(), HasSubstr("'lead' turns without end, and a joint that follows it"));
}

std::string refusal(const std::string& text) try {
  return imported(text).model;
} catch (const InputError& error) {
  return error.what();
}

TEST(Urdf, KeepsFollowersWithinTheirLimits) {
  const std::string limits = "<limit lower='-2' upper='1'/>";
  EXPECT_THAT(
      imported(follower_arm("continuous", "revolute", "multiplier='-2' offset='0.5'/>" + limits))
          .model,
      HasSubstr("lead = [-0.25, 1.25] # within the limits of 'back'"));
  EXPECT_THAT(
      imported(follower_arm("revolute", "revolute", "multiplier='-2' offset='0.5'/>" + limits,
                            "<limit lower='-1' upper='1'/>"))
          .model,
      HasSubstr("lead = [-0.25, 1] # within the limits of 'back'"));
  EXPECT_THAT(imported(follower_arm("revolute", "revolute", "/>" + limits,
                                    "<limit lower='-1' upper='0.5'/>"))
                  .model,
              HasSubstr("lead = [-1, 0.5]\n"));
  for (const char* rule : {"multiplier='1'/>", "multiplier='0' offset='1.5'/>"})
    EXPECT_THAT(refusal(follower_arm("revolute", "revolute", rule + limits,
                                     "<limit lower='2' upper='3'/>")),
                HasSubstr("joint 'back' follows joint 'lead' and is outside its own limits"));
}

TEST(Urdf, MakesNamesThatModelsMayUse) {
  const Imported arm = imported(arm_with(second("<axis xyz='0 1 0'/>", "revolute", "2nd joint/x")));
  EXPECT_THAT(arm.model, HasSubstr("name = \"q_2nd_joint_x\""));
  EXPECT_THAT(arm.report(), HasSubstr("'2nd joint/x' is q_2nd_joint_x"));
  EXPECT_THAT(imported(arm_with(second("<axis xyz='0 1 0'/>", "revolute", "alpha"))).model,
              HasSubstr("name = \"q_alpha\""));
  EXPECT_THAT(imported(arm_with(second("<axis xyz='0 1 0'/>", "revolute", "sin"))).model,
              HasSubstr("name = \"q_sin\""));
}

TEST(Urdf, HasNoHomeOutsideTheLimits) {
  const std::string text = arm_with(second("<axis xyz='0 1 0'/><limit lower='0.5' upper='1'/>"));
  EXPECT_THAT(imported(text).model, Not(HasSubstr("motion.home")));
  EXPECT_THAT(imported(text).report(), HasSubstr("no motion 'home'"));
  EXPECT_THAT(imported(arm_with(second("<axis xyz='0 1 0'/>"))).model, HasSubstr("motion.home"));
}

TEST(Urdf, KeepsPrismaticJointsAndFixedFrames) {
  const Imported arm = imported(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>"
      "<joint name='rail' type='prismatic'><parent link='a'/><child link='b'/><axis xyz='1 0 0'/>"
      "<limit lower='0' upper='2'/></joint>"
      "<joint name='mount' type='fixed'><parent link='b'/><child link='c'/><origin xyz='0 0 "
      "1'/></joint>"
      "<joint name='turn' type='revolute'><parent link='c'/><child link='d'/><axis xyz='0 1 0'/>"
      "<limit lower='0' upper='2'/></joint></robot>");
  EXPECT_THAT(arm.model, HasSubstr("{ name = \"rail\", type = \"prismatic\", axis = [1, 0, 0] }"));
  EXPECT_THAT(arm.model, HasSubstr("{ type = \"fixed\", xyz = [0, 0, 1] }, # 'mount'"));
}

/// The part of the model that the file's bytes do not change.
std::string tables_of(const std::string& text) {
  const std::string model = imported(text).model;
  return model.substr(model.find("[serial]"));
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(Urdf, MeansTheSameInEveryWayOfWriting) {
  const std::string plain = arm_with(second("<origin xyz='0 0 0.3'/><axis xyz='0 1 0'/>"));
  const std::string tables = tables_of(plain);
  for (const std::string& other :
       {with(plain, "\n", "\r\n"), "\xEF\xBB\xBF" + plain,
        "<?xml version='1.0'?>\n<!-- | autogenerated by xacro | -->\n" + plain,
        with(plain, "<robot ", "<robot xmlns:xacro='http://www.ros.org/wiki/xacro' "),
        with(plain, "0 0 0.3", "\t0.0E+00\n -0. +3.0e-1 "), with(plain, "0 1 0", "-0 1. 0.0"),
        with(plain, "'revolute'", "' revolute '"),
        with(plain, "</robot>",
             "<xacro:property name='d' value='1'/><gazebo reference='a'><joint name='x'/></gazebo>"
             "<transmission name='t'><joint name='first'/></transmission><material name='m'/>"
             "</robot>"),
        with(plain, "</joint>",
             "<safety_controller k_velocity='1'/><dynamics damping='0.1'/><calibration rising='0'/>"
             "</joint>"),
        with(plain, "<link name='a'/>",
             "<link name='a'><visual><geometry><mesh filename='package://x/a.stl'/></geometry>"
             "</visual></link>")})
    EXPECT_EQ(tables_of(other), tables) << other;
}

TEST(Urdf, HasNoLimitWhereItIsInfinite) {
  for (const char* limit : {"lower='-inf' upper='inf'", "lower='-1e16' upper='1e+16'"}) {
    const Imported arm =
        imported(arm_with(second(std::string("<axis xyz='0 1 0'/><limit ") + limit + "/>")));
    EXPECT_THAT(arm.report(), HasSubstr("joint 'second' has no limits")) << limit;
  }
}

TEST(Urdf, SaysWhichAnglesAreNearlyQuarterTurns) {
  const std::string arm = arm_with(second("<origin rpy='1.5708 0 0'/><axis xyz='0 1 0'/>"));
  EXPECT_THAT(imported(arm).report(),
              HasSubstr("1.5708 is not pi/2; if it is meant, --snap 1e-4 takes it for that"));
  EXPECT_THAT(imported(arm, {.snap = "1e-4"}).report(), Not(HasSubstr("is not pi/2")));
  EXPECT_THAT(imported(arm, {.snap = "0"}).report(), Not(HasSubstr("is not pi/2")));
}

TEST(Urdf, LeavesLengthsOfFewDigitsWhereAnglesAreSnapped) {
  const std::string arm = arm_with(
      second("<origin xyz='0.28358 0.0014165 0.30000001192' rpy='1.5708 0 0'/><axis xyz='0 1 "
             "0'/>"));
  for (const char* snap : {"1e-4", "1e-2"}) {
    const std::string model = imported(arm, {.snap = snap}).model;
    EXPECT_THAT(model, HasSubstr("xyz = [0.28358, 0.0014165, 0.3], rpy = [\"pi/2\", 0, 0]"));
  }
}

/// An arm of two joints; a cylinder and two fingers that follow joints.
std::string arm_with_followers() {
  return "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='rod'/>"
         "<link name='left'/><link name='right'/>"
         "<joint name='i' type='revolute'><parent link='a'/><child link='b'/></joint>"
         "<joint name='j' type='revolute'><parent link='b'/><child link='c'/><axis xyz='0 1 "
         "0'/></joint>"
         "<joint name='k' type='continuous'><parent link='a'/><child link='rod'/>"
         "<mimic joint='i' multiplier='-1'/></joint>";
}

std::string finger(const std::string& name, const std::string& mimic) {
  return "<joint name='" + name + "_finger' type='prismatic'><parent link='c'/><child link='" +
         name + "'/>" + mimic + "</joint>";
}

TEST(Urdf, TakesNoCylinderForTheTip) {
  EXPECT_THAT(imported(arm_with_followers() + "</robot>").report(),
              HasSubstr("from 'a' to 'c': 2 joints that move"));
}

TEST(Urdf, WritesJointsOfTheArmThatFollow) {
  const std::string text =
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>"
      "<joint name='follower' type='revolute'><parent link='a'/><child link='b'/>"
      "<limit lower='-6' upper='6'/><mimic joint='the leader' multiplier='-1.0' "
      "offset='1.5707963267948966'/></joint>"
      "<joint name='the leader' type='revolute'><parent link='b'/><child link='c'/><axis xyz='0 1 "
      "0'/><limit lower='-1' upper='1'/></joint>"
      "<joint name='k' type='revolute'><parent link='c'/><child link='d'/><axis xyz='0 0 "
      "1'/></joint></robot>";
  const Imported arm = imported(text);
  EXPECT_THAT(arm.model,
              HasSubstr("{ mimic = \"the_leader\", multiplier = -1, offset = \"pi/2\", axis = [1, "
                        "0, 0] }, # 'follower'\n"));
  EXPECT_THAT(arm.model, Not(HasSubstr("follower = [")));
  EXPECT_THAT(arm.report(), HasSubstr("2 joints that move, 0 fixed, 1 that follow others"));
  EXPECT_EQ(model_of(text).pose.size(), 2U);
}

TEST(Urdf, HasNoFollowersOfAJointWithoutAName) {
  const std::string joint = "<axis xyz='0 1 0'/><limit lower='-9' upper='9'/>";
  const std::string last = imported(arm_with(second(joint, "revolute", ""))).model;
  EXPECT_THAT(last, HasSubstr("first = [-1, 1]\n"));
  EXPECT_THAT(last, Not(HasSubstr("mimic")));
  const std::string leads = arm_with(second(joint));
  const std::string first = std::string(leads).replace(leads.find("'first'"), 7, "''");
  EXPECT_THAT(imported(first).model, Not(HasSubstr("mimic")));
}

TEST(Urdf, DoesNotChooseBetweenFingers) {
  const std::string hand = arm_with_followers() + finger("left", "") +
                           finger("right", "<mimic joint='left_finger'/>") + "</robot>";
  try {
    static_cast<void>(imported(hand));
    FAIL() << "a finger became the tip";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("left (3 joints), right (3 joints)"));
    EXPECT_THAT(error.what(), HasSubstr("such as c, behind which they part"));
  }
}

}  // namespace
}  // namespace regulus::detail::test::urdf
