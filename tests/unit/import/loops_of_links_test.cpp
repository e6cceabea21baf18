// SPDX-License-Identifier: GPL-3.0-or-later
// Robots with loops of any kind as models with a [closure].
#include <gmock/gmock.h>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
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
  EXPECT_THAT(model, HasSubstr("push = [\"0 - 0.0"));
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

}  // namespace
}  // namespace regulus
