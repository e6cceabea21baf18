// SPDX-License-Identifier: GPL-3.0-or-later
// Robots in the plane with loops: the legs that are found, and those that are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail::test::planar_legs {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A stage on two cranks and one carriage. Leg 1 is bent to the right of the line to the stage, leg 2
/// to the left; the carriage of leg 3 is before the stage on its rail.
constexpr const char* kStage = R"(<mujoco model="stage">
  <worldbody>
    <body name="crank_1"><joint name="motor_1" axis="0 0 1"/>
      <body name="link_1" pos="0.3 0 0"><joint name="elbow_1" axis="0 0 1"/></body></body>
    <body name="crank_2" pos="1 0 0"><joint name="motor_2" axis="0 0 1"/>
      <body name="link_2" pos="0.3 0 0"><joint name="elbow_2" axis="0 0 -1"/></body></body>
    <body name="carriage" pos="0 0.8 0"><joint name="rail" type="slide" axis="1 0 0"/>
      <body name="link_3"><joint name="hinge" axis="0 0 1"/>
        <body name="stage" pos="0.3 -0.4 0"><joint name="wrist" axis="0 0 1"/></body></body></body>
  </worldbody>
  <equality>
    <connect body1="stage" body2="link_1" anchor="0 0 0"/>
    <connect body1="stage" body2="link_2" anchor="0.4 0 0"/>
  </equality>
</mujoco>
)";

/// Two cranks whose rods meet in one point, in the plane of y and z.
constexpr const char* kFiveBar = R"(<robot name="five-bar">
  <link name="base"/><link name="a"/><link name="b"/><link name="b_end"/>
  <link name="c"/><link name="d"/><link name="d_end"/>
  <joint name="left" type="continuous"><parent link="base"/><child link="a"/>
    <origin xyz="0 -0.1 0"/><axis xyz="1 0 0"/></joint>
  <joint name="left_elbow" type="continuous"><parent link="a"/><child link="b"/>
    <origin xyz="0 -0.2 0.2"/><axis xyz="1 0 0"/></joint>
  <joint name="left_end" type="fixed"><parent link="b"/><child link="b_end"/>
    <origin xyz="0 0.3 0.4"/></joint>
  <joint name="right" type="continuous"><parent link="base"/><child link="c"/>
    <origin xyz="0 0.1 0"/><axis xyz="-1 0 0"/></joint>
  <joint name="right_elbow" type="continuous"><parent link="c"/><child link="d"/>
    <origin xyz="0 0.2 0.2"/><axis xyz="1 0 0"/></joint>
  <joint name="right_end" type="fixed"><parent link="d"/><child link="d_end"/>
    <origin xyz="0 -0.3 0.4"/></joint>
</robot>
)";

std::string imported(const std::string& text, ImportOptions options = {}) {
  const Imported robot = import_robot(text, "r.xml", options);
  static_cast<void>(parse_model(robot.model, "r.toml"));
  return robot.model;
}

std::string refusal(const std::string& text, ImportOptions options = {}) try {
  return imported(text, options);
} catch (const InputError& error) {
  return error.what();
} catch (const UsageError& error) {
  return error.what();
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(APlanarStage, HasItsLegs) {
  const std::string model = imported(kStage);
  EXPECT_THAT(model, HasSubstr("from 'world' to 'stage'; x y of the model is the plane xy"));
  EXPECT_THAT(model, HasSubstr("type = \"RRR\"\nbase = [0, 0]\nplatform = [0, 0]\ncrank = 0.3\n"
                               "rod = 0.4\nmode = \"-\"\nactuated = 1\n"));
  EXPECT_THAT(model, HasSubstr("type = \"RRR\"\nbase = [1, 0]\nplatform = [0.4, 0]\ncrank = 0.3\n"
                               "rod = \"(1/5)*sqrt(13)\"\nmode = \"-\"\nactuated = 1\n"));
  EXPECT_THAT(model, HasSubstr("type = \"PRR\"\nbase = [0, 0.8]\nplatform = [0, 0]\naxis = [1, 0]\n"
                               "rod = 0.5\nmode = \"-\"\nactuated = 1\n"));
  EXPECT_THAT(model, HasSubstr("[motion.home] # every joint at zero\nx = 0.3\ny = 0.4\nphi = 0\n"));
}

TEST(APlanarStage, IsDrivenWhereItIsSaid) {
  EXPECT_THAT(imported(kStage, {.actuated = {"elbow_1,wrist"}}),
              AllOf(HasSubstr("mode = \"-\"\nactuated = 2\n"), HasSubstr("actuated = 3\n")));
  EXPECT_THAT(refusal(kStage, {.actuated = {"motor_1", "elbow_1"}}),
              HasSubstr("has another driven joint already"));
  EXPECT_THAT(refusal(kStage, {.actuated = {"motor"}}), HasSubstr("the legs have 'motor_1'"));
}

TEST(APlanarStage, MayHaveALegOfVariableLength) {
  const std::string rod = "<body name=\"link_1\" pos=\"0.3 0 0\"><joint name=\"elbow_1\" ";
  const std::string slide =
      with(kStage, rod + "axis=\"0 0 1\"/>",
           "<body name=\"link_1\" pos=\"0.3 0.4 0\"><joint name=\"rod_1\" type=\"slide\" "
           "axis=\"3 4 0\"/>");
  EXPECT_THAT(imported(slide),
              HasSubstr("# motor_1, rod_1, connect\ntype = \"RPR\"\nbase = [0, 0]\n"
                        "platform = [0, 0]\nactuated = 2\n"));
  EXPECT_THAT(refusal(with(slide, "3 4 0", "4 3 0")),
              HasSubstr("a leg in the plane has the joints RPR ('motor_1', 'rod_1', 'connect')"));
}

TEST(APlanarStage, IsRefusedIfAJointOfALegFollows) {
  EXPECT_THAT(refusal(with(kStage, "<equality>",
                           "<equality><joint joint1=\"motor_2\" joint2=\"motor_1\"/>")),
              HasSubstr("joint 'motor_2' of a leg follows joint 'motor_1'"));
}

TEST(APlanarStage, IsBentWhereItsModeIsTaken) {
  EXPECT_THAT(refusal(with(kStage, "pos=\"0.3 0 0\"><joint name=\"elbow_1\"",
                           "pos=\"0.15 0.2 0\"><joint name=\"elbow_1\"")),
              HasSubstr("is stretched or folded with every joint at zero"));
}

TEST(AFiveBar, EndsInAPoint) {
  const std::string model = imported(kFiveBar, {.cuts = {"b_end=d_end"}});
  EXPECT_THAT(model, HasSubstr("x y of the model is the plane yz"));
  EXPECT_THAT(model, HasSubstr("orientation = \"point\"\n"));
  EXPECT_THAT(model, HasSubstr("base = [-0.1, 0]\ncrank = \"(1/5)*sqrt(2)\"\nrod = 0.5\n"
                               "mode = \"+\"\n"));
  EXPECT_THAT(model, HasSubstr("base = [0.1, 0]\ncrank = \"(1/5)*sqrt(2)\"\nrod = 0.5\n"
                               "mode = \"-\"\n"));
  EXPECT_THAT(model, HasSubstr("x = 0\ny = 0.6\n"));
}

TEST(AFiveBar, HasTheSameMotorsAsAClosure) {
  const auto tables = [](ImportOptions options) {
    options.cuts = {"b_end=d_end"};
    options.closure = true;
    const std::string model = imported(kFiveBar, options);
    // The order of the terms of an equation is GiNaC's.
    return model.substr(model.find("[pose]"), model.find("equations") - model.find("[pose]"));
  };
  EXPECT_THAT(tables({}), HasSubstr("[closure]"));
  EXPECT_EQ(tables({}), tables({.actuated = {"left,right"}}));
}

TEST(AClosedMechanism, OfNoKnownFormAsksForItsMotors) {
  EXPECT_THAT(refusal(with(kFiveBar, "<origin xyz=\"0 -0.3 0.4\"/>", "<origin xyz=\"0 0 0.4\"/>"),
                      {.cuts = {"b_end=d_end"}}),
              HasSubstr("the loops leave 2 freedoms; name as many driven joints"));
  EXPECT_THAT(refusal(with(kFiveBar, "<axis xyz=\"-1 0 0\"/>", "<axis xyz=\"0 1 0\"/>"),
                      {.cuts = {"b_end=d_end"}}),
              HasSubstr("the loops leave 1 freedom"));
  EXPECT_THAT(refusal(kFiveBar), HasSubstr("--cut LINK=LINK"));
}

}  // namespace
}  // namespace regulus::detail::test::planar_legs
