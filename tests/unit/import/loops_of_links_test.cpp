// SPDX-License-Identifier: GPL-3.0-or-later
// Robots with loops of any kind as models with a [closure].
#include <gmock/gmock.h>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;

/// A four-bar in the plane of x and y, closed where every joint is at zero: ground 0.5, crank 0.3,
/// coupler 0.5, rocker 0.3. `gap`: how far its end is off.
std::string four_bar(const std::string& gap = "0", const std::string& more = "") {
  return R"(<robot name="four-bar">
  <link name="base"/><link name="crank"/><link name="coupler"/><link name="tip"/>
  <link name="rocker"/><link name="pin"/>
  <joint name="motor" type="continuous">
    <parent link="base"/><child link="crank"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="crank"/><child link="coupler"/><origin xyz="0 0.3 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="end" type="fixed">
    <parent link="coupler"/><child link="tip"/><origin xyz="0.5 )" +
         gap + R"( 0"/>
  </joint>
  <joint name="swing" type="continuous">
    <parent link="base"/><child link="rocker"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="top" type="continuous">
    <parent link="rocker"/><child link="pin"/><origin xyz="0 0.3 0"/><axis xyz="0 0 1"/>
  </joint>)" +
         more + "</robot>";
}

Imported imported(const std::string& text, const ImportOptions& options) {
  Imported robot = import_robot(text, "r.xml", options);
  EXPECT_TRUE(parse_model(robot.model, "r.toml").closure) << robot.model;
  return robot;
}

ImportOptions welded() {
  ImportOptions options;
  options.welds = {"tip=pin"};
  options.actuated = {"motor"};
  return options;
}

TEST(ClosedLoops, OfAFourBarAreTwoEquationsWithTheFilesNumbers) {
  const std::string model = imported(four_bar(), welded()).model;
  EXPECT_THAT(model, HasSubstr("unknowns = { elbow = \"rad\", swing = \"rad\" }"));
  EXPECT_THAT(model, HasSubstr("start = { motor = 0, elbow = 0, swing = 0 }"));
  EXPECT_THAT(model, HasSubstr("[motion.home]\nmotor = 0\n"));
  EXPECT_THAT(model, HasSubstr("motor = [\"-5*deg\", \"5*deg\"]"));
}

TEST(ClosedLoops, InAPlaneDropTheEquationsOutOfIt) {
  EXPECT_THAT(imported(four_bar(), welded()).report(),
              HasSubstr("3 of 5 equations are always true and were dropped"));
}

TEST(ClosedLoops, ThatAreOpenAreClosedAndTheReportSaysHowFar) {
  const std::string report = imported(four_bar("0.01"), welded()).report();
  EXPECT_THAT(report, HasSubstr("the loops are open by 0.01 in the file's pose"));
  EXPECT_THAT(report, HasSubstr(" deg, and no joint by more"));
}

TEST(ClosedLoops, AreClosedFromThePoseThatTheUserGives) {
  ImportOptions options = welded();
  options.at = {"motor=20*deg"};
  EXPECT_THAT(imported(four_bar(), options).model, HasSubstr("motor = 0.349065"));
}

TEST(ClosedLoops, ComeFromAListBesideTheFile) {
  ImportOptions options;
  options.list = "# closures\nclosed_loop: [['tip', \"pin\"]]\ntype: [6d]\nname_mot: ['motor']\n";
  options.list_file = "r.yaml";
  EXPECT_EQ(imported(four_bar(), options).model.substr(0, 1), "#");
  EXPECT_THAT(imported(four_bar(), options).report(), HasSubstr("driven: 'motor'"));
}

TEST(ClosedLoops, ComeFromConstraintElements) {
  const std::string constraint = R"(<constraint name="pivot" type="revolute">
    <parent link="coupler"/><parent_origin xyz="0.5 0 0"/><parent_axis xyz="0 0 1"/>
    <child link="rocker"/><child_origin xyz="0 0.3 0"/><child_axis xyz="0 0 1"/>
  </constraint>)";
  ImportOptions options;
  options.actuated = {"motor"};
  options.closure = true;
  EXPECT_THAT(imported(four_bar("0", constraint), options).model,
              HasSubstr("unknowns = { elbow = \"rad\", swing = \"rad\" }"));
}

TEST(ClosedLoops, ThatFollowAMotorHaveNoUnknownForIt) {
  // The rocker follows the crank: the coupler stays level.
  std::string text = four_bar();
  const std::string swing = "<origin xyz=\"0.5 0 0\"/>";
  text.insert(text.rfind(swing), "<mimic joint=\"motor\"/>");
  EXPECT_THROW((void)imported(text, welded()),
               InputError);  // it moves anyway: one equation too many
}

TEST(ClosedLoops, WithASliderHaveAMotionOfItsMotor) {
  const std::string text = R"(<robot name="slider">
  <link name="base"/><link name="crank"/><link name="rod"/><link name="end"/><link name="cart"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="knee" type="continuous">
    <parent link="crank"/><child link="rod"/><origin xyz="0 0.3 0"/><axis xyz="0 0 1"/></joint>
  <joint name="wrist" type="continuous">
    <parent link="rod"/><child link="end"/><origin xyz="0.4 -0.3 0"/><axis xyz="0 0 1"/></joint>
  <joint name="push" type="prismatic">
    <parent link="base"/><child link="cart"/><origin xyz="0.4 0 0"/><axis xyz="1 0 0"/></joint>
  </robot>)";
  ImportOptions options;
  options.welds = {"end=cart"};
  options.actuated = {"push"};
  const std::string model = imported(text, options).model;
  EXPECT_THAT(model, HasSubstr("push = \"m\""));
  EXPECT_THAT(model, HasSubstr("push = [\"-0.0"));
}

TEST(ClosedLoops, OfRodsBetweenBallsAreOneEquationEach) {
  const std::string text = R"(<mujoco model="rssr"><compiler angle="radian"/><worldbody>
    <body name="crank"><joint name="motor" type="hinge" axis="0 0 1"/>
      <body name="rod" pos="0.1 0.1 0"><joint name="ball" type="ball"/></body></body>
    <body name="rocker" pos="0.5 0 0"><joint name="swing" type="hinge" axis="1 0 0"/></body>
    </worldbody><equality><connect body1="rod" body2="rocker" anchor="0.4 0.1 0.2"/></equality>
    </mujoco>)";
  ImportOptions options;
  options.actuated = {"motor"};
  const Imported robot = imported(text, options);
  EXPECT_THAT(robot.model, HasSubstr("unknowns = { swing = \"rad\" }"));
  EXPECT_THAT(robot.report(), HasSubstr("1 equation in as many passive joints"));
}

TEST(ClosedLoops, OfSdfAreClosedByAJointWhoseChildHasAnother) {
  const std::string text = R"(<sdf version="1.9"><model name="bars">
    <link name="base"/><link name="crank"/>
    <link name="coupler"><pose>0 0.3 0 0 0 0</pose></link>
    <link name="rocker"><pose>0.5 0 0 0 0 0</pose></link>
    <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
    <joint name="motor" type="revolute"><parent>base</parent><child>crank</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
    <joint name="elbow" type="revolute"><parent>crank</parent><child>coupler</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
    <joint name="swing" type="revolute"><parent>base</parent><child>rocker</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
    <joint name="top" type="revolute"><pose relative_to="rocker">0 0.3 0 0 0 0</pose>
      <parent>coupler</parent><child>rocker</child><axis><xyz>0 0 1</xyz></axis></joint>
    </model></sdf>)";
  ImportOptions options;
  options.actuated = {"motor"};
  EXPECT_THAT(imported(text, options).model, HasSubstr("motor = 0"));
}

TEST(ClosedLoops, HoldAJointThatNothingDetermines) {
  // Two pins in line: the one between them spins.
  std::string text = four_bar();
  const std::string pin = "<link name=\"pin\"/>";
  text.insert(text.find(pin), "<link name=\"bush\"/>");
  text.insert(text.find("</robot>"), R"(<joint name="bushing" type="continuous">
    <parent link="tip"/><child link="bush"/><axis xyz="0 0 1"/></joint>)");
  ImportOptions options = welded();
  options.welds = {"bush=pin"};
  EXPECT_THAT(imported(text, options).report(), HasSubstr("no motor and no loop determines"));
}

std::string refusal_of(const std::string& text, const ImportOptions& options) {
  try {
    return import_robot(text, "r.xml", options).model;
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

/// A joint and the link behind it; `more` stands in the joint.
std::string joint(const std::string& name, const std::string& parent, const std::string& xyz,
                  const std::string& axis, const std::string& more = "",
                  const std::string& type = "revolute") {
  return "<link name=\"" + name + "_link\"/><joint name=\"" + name + "\" type=\"" + type +
         "\"><parent link=\"" + parent + "\"/><child link=\"" + name + "_link\"/><origin xyz=\"" +
         xyz + "\"/><axis xyz=\"" + axis + "\"/>" + more + "</joint>";
}

std::string robot_of(const std::string& joints) {
  return "<robot name=\"r\"><link name=\"base\"/>" + joints + "</robot>";
}

/// The four-bar about an axis that crosses both; `of_swing`, `of_top`: more of these joints.
std::string bars(const std::string& axis, const std::string& across, const std::string& up,
                 const std::string& of_swing = "", const std::string& of_motor = "") {
  return robot_of(
      joint("motor", "base", "0 0 0", axis, of_motor) + joint("elbow", "motor_link", up, axis) +
      joint("end", "elbow_link", across, axis, "", "fixed") +
      joint("swing", "base", across, axis, of_swing) + joint("top", "swing_link", up, axis));
}

ImportOptions ends_meet(const std::string& motor) {
  ImportOptions options;
  options.welds = {"end_link=top_link"};
  options.actuated = {motor};
  options.closure = true;
  return options;
}

TEST(ClosedLoops, WithAFreedomThatNoMotorHoldsAreRefused) {
  // Five bars with one motor: the point moves while it is locked.
  const std::string five = robot_of(joint("left", "base", "-0.1 0 0", "0 0 1") +
                                    joint("elbow", "left_link", "-0.3 0.4 0", "0 0 1") +
                                    joint("end", "elbow_link", "0.4 0.3 0", "0 0 1", "", "fixed") +
                                    joint("right", "base", "0.1 0 0", "0 0 1") +
                                    joint("fold", "right_link", "0.3 0.4 0", "0 0 1") +
                                    joint("top", "fold_link", "-0.4 0.3 0", "0 0 1"));
  const std::string message = refusal_of(five, ends_meet("left"));
  EXPECT_THAT(message, HasSubstr("the loops leave 1 freedom that no motor holds"));
  EXPECT_THAT(message, HasSubstr("--actuated left,"));
  ImportOptions both = ends_meet("left");
  both.actuated.emplace_back("right");
  EXPECT_TRUE(parse_model(imported(five, both).model, "r.toml").closure);
}

TEST(ClosedLoops, HoldALinkBetweenTwoPinsInLineWhereverTheLoopIsCut) {
  // The motor and another pin turn about one axis, and the loop is cut elsewhere.
  const std::string text = robot_of(joint("motor", "base", "0 0 0", "0 0 1") +
                                    joint("elbow", "motor_link", "0 0.3 0", "0 0 1") +
                                    joint("bush", "elbow_link", "0 0 0.1", "0 0 1") +
                                    joint("end", "bush_link", "0.5 0 0", "0 0 1", "", "fixed") +
                                    joint("swing", "base", "0.5 0 0.1", "0 0 1") +
                                    joint("top", "swing_link", "0 0.3 0", "0 0 1"));
  EXPECT_THAT(imported(text, ends_meet("motor")).report(),
              HasSubstr("exact algebra shows that it moves no more than links between pins"));
}

TEST(ClosedLoops, InASlantedPlaneDropTheEquationsOutOfIt) {
  const Imported robot = imported(bars("0.6 0 0.8", "0.4 0 -0.3", "0 0.3 0"), ends_meet("motor"));
  EXPECT_THAT(robot.report(), HasSubstr("3 of 5 equations are always true and were dropped"));
  EXPECT_THAT(robot.report(), HasSubstr("2 equations in as many passive joints"));
}

TEST(ClosedLoops, OfSarrusLoseTheEquationThatFollows) {
  const std::string text = robot_of(
      joint("motor", "base", "0 0 0", "1 0 0") + joint("knee", "motor_link", "0 0.3 0.4", "1 0 0") +
      joint("hip", "knee_link", "0 -0.3 0.4", "1 0 0") +
      joint("end", "hip_link", "0.2 0 0", "0 0 1", "", "fixed") +
      joint("foot", "base", "0.2 0 0", "0 1 0") + joint("shin", "foot_link", "0.3 0 0.4", "0 1 0") +
      joint("top", "shin_link", "-0.3 0 0.4", "0 1 0"));
  const Imported robot = imported(text, ends_meet("motor"));
  EXPECT_THAT(robot.report(), HasSubstr("1 of 5 equations are always true and were dropped"));
  EXPECT_THAT(robot.report(), HasSubstr("4 equations in as many passive joints"));
}

TEST(ClosedLoops, OfBennettAreRefusedBecauseTheirEquationsFollowOnTheLoopAlone) {
  // Links 1 and 2 with twists of 30 and 90 degrees: sin(30)/1 = sin(90)/2.
  const auto turned = [](const std::string& name, const std::string& parent, const std::string& xyz,
                         const std::string& roll, const std::string& type) {
    std::string text = joint(name, parent, xyz, "0 0 1", "", type);
    return text.insert(text.find("\"/><axis"), "\" rpy=\"" + roll + " 0 0");
  };
  const std::string text =
      robot_of(joint("motor", "base", "0 0 0", "0 0 1") +
               turned("elbow", "motor_link", "0.1 0 0", "0.5235987755982988", "revolute") +
               turned("wrist", "elbow_link", "0.2 0 0", "1.5707963267948966", "revolute") +
               turned("end", "wrist_link", "0.1 0 0", "0.5235987755982988", "fixed") +
               turned("top", "base", "-0.2 0 0", "-1.5707963267948966", "revolute"));
  ImportOptions options = ends_meet("motor");
  options.at = {"motor=1", "elbow=2.53", "wrist=-1"};
  EXPECT_THAT(refusal_of(text, options), HasSubstr("follow from others near the start"));
}

TEST(ClosedLoops, ThatAreRigidAreRefusedAsRigid) {
  const std::string text = robot_of(joint("motor", "base", "0 0 0", "0 0 1") +
                                    joint("end", "motor_link", "0.3 0.4 0", "0 0 1", "", "fixed") +
                                    joint("swing", "base", "0.3 0 0.1", "0 0 1") +
                                    joint("top", "swing_link", "0 0.4 -0.1", "0 0 1"));
  EXPECT_THAT(refusal_of(text, ends_meet("motor")), HasSubstr("is rigid"));
}

TEST(ClosedLoops, HaveTheLimitsOfTheFile) {
  const std::string text =
      bars("0 0 1", "0.5 0 0", "0 0.3 0", "<limit lower=\"-0.5\" upper=\"1.5707963267948966\"/>",
           "<limit lower=\"-0.05\" upper=\"2\"/>");
  const Imported robot = imported(text, ends_meet("motor"));
  EXPECT_THAT(robot.model, HasSubstr("range = { swing = [-0.5, \"pi/2\"] }"));
  EXPECT_THAT(robot.model, HasSubstr("motor = [-0.05, \"5*deg\"]"));
}

TEST(ClosedLoops, SayWhichLimitsTheModelLeavesOut) {
  const std::string beyond =
      bars("0 0 1", "0.5 0 0", "0 0.3 0", "<limit lower=\"0.2\" upper=\"1\"/>");
  const Imported robot = imported(beyond, ends_meet("motor"));
  EXPECT_THAT(robot.report(), HasSubstr("the start is beyond the limits of 'swing'"));
  EXPECT_EQ(robot.model.find("range ="), std::string::npos);
  std::string all = bars("0 0 1", "0.5 0 0", "0 0.3 0");
  for (const char* name : {"elbow", "swing", "top"}) {
    const std::size_t at = all.find("</joint>", all.find("joint name=\"" + std::string(name)));
    all.insert(at, "<limit lower=\"-1\" upper=\"1\"/>");
  }
  EXPECT_THAT(imported(all, ends_meet("motor")).report(),
              HasSubstr("the limits of 'top' are no part of the model"));
}

TEST(ClosedLoops, AreCutAtAJointWithoutLimits) {
  std::string text = bars("0 0 1", "0.5 0 0", "0 0.3 0");
  text.insert(text.rfind("</joint>"), "<limit lower=\"-1\" upper=\"1\"/>");  // of the top
  EXPECT_THAT(imported(text, ends_meet("motor")).model, HasSubstr("range = { top = [-1, 1] }"));
}

TEST(ClosedLoops, AreDrivenByTheMotorOfAJointThatFollows) {
  std::string text = bars("0 0 1", "0.5 0 0", "0 0.3 0");
  text.insert(text.find("</robot>"), joint("gear", "base", "0 0 1", "0 0 1",
                                           "<mimic joint=\"motor\" multiplier=\"-2\"/>"));
  const Imported robot = imported(text, ends_meet("gear"));
  EXPECT_THAT(robot.report(), HasSubstr("the motor of 'gear' drives 'motor', which it follows"));
  EXPECT_THAT(robot.model, HasSubstr("[pose] # the driven joints\nmotor = \"rad\""));
}

TEST(ClosedLoops, OfOneBodyMustBeClosed) {
  std::string text = bars("0 0 1", "0.5 0 0", "0 0.3 0");
  text.insert(text.find("</robot>"), joint("mark", "base", "0 0 1", "0 0 1", "", "fixed"));
  ImportOptions options = ends_meet("motor");
  options.welds.emplace_back("base=mark_link");
  EXPECT_THAT(refusal_of(text, options), HasSubstr("ties frames of one body that are apart"));
}

TEST(ClosedLoops, KeepJointsApartWhoseMadeNamesAreThoseOfOthers) {
  // The second joint of the universal 'elbow' would be elbow_2, which the file has.
  const std::string text = robot_of(joint("motor", "base", "0 0 0", "0 0 1") +
                                    joint("elbow", "motor_link", "0 0.3 0", "0 0 1") +
                                    joint("elbow_2", "elbow_link", "0.2 0 0.1", "0 1 0") +
                                    joint("roll", "elbow_2_link", "0.1 0.1 0", "1 0 0") +
                                    joint("end", "roll_link", "0.2 0 0", "0 0 1", "", "fixed") +
                                    joint("swing", "base", "0.5 0 0", "0 1 0") +
                                    joint("top", "swing_link", "0 0.3 0.1", "0 0 1"));
  ImportOptions options = ends_meet("motor");
  options.list = "joint_name: [elbow]\njoint_type: [UJOINT_ZY]\n";
  options.list_file = "r.yaml";
  EXPECT_THAT(imported(text, options).model, HasSubstr("elbow_2_2 = \"rad\""));
}

/// A crank, a rod with three hinges about the point of its foot, and a lid, which meet in a point.
std::string rod_of_hinges(const std::string& third) {
  return robot_of(joint("motor", "base", "0 0 0", "0 0 1") +
                  joint("a", "motor_link", "0.1 0.1 0", "1 0 0") +
                  joint("b", "a_link", "0 0 0", "0 1 0") + joint("c", "b_link", "0 0 0", third) +
                  joint("end", "c_link", "0.4 0.1 0.2", "0 0 1", "", "fixed") +
                  joint("swing", "base", "0.5 0 0", "1 0 0") +
                  joint("top", "swing_link", "0 0.2 0.2", "0 0 1", "", "fixed"));
}

TEST(ClosedLoops, TakeThreeHingesAtRightAnglesForABallAndSaySo) {
  ImportOptions options;
  options.cuts = {"end_link=top_link"};
  options.actuated = {"motor"};
  EXPECT_THAT(imported(rod_of_hinges("0 0 1"), options).report(),
              HasSubstr("'a', 'b', 'c' are taken as a ball"));
  // These have not all orientations; with a point at the other end one of them is not determined.
  EXPECT_THAT(refusal_of(rod_of_hinges("0 1 1"), options), HasSubstr("that no motor holds"));
}

TEST(ClosedLoops, SayTheDistanceByWhichARodIsTooLong) {
  std::string text = rod_of_hinges("0 0 1");
  text.replace(text.find("0 0.2 0.2"), 9, "0 0.2 0.21");
  ImportOptions options;
  options.cuts = {"end_link=top_link"};
  options.actuated = {"motor"};
  EXPECT_THAT(imported(text, options).report(), HasSubstr("the loops are open by 0.00445"));
}

}  // namespace
}  // namespace regulus::detail
