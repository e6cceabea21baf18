// SPDX-License-Identifier: GPL-3.0-or-later
// Loops that equalities of MJCF close.
#include <gmock/gmock.h>

#include "codegen/model/import/import.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;

/// The bars of a four-bar in the plane of x and y, as MJCF has them; `equality` closes them.
std::string mjcf_bars(const std::string& equality) {
  return R"(<mujoco model="bars"><compiler angle="radian"/><worldbody>
    <body name="crank"><joint name="motor" axis="0 0 1"/>
      <body name="coupler" pos="0 0.3 0"><joint name="elbow" axis="0 0 1"/></body></body>
    <body name="rocker" pos="0.5 0 0"><joint name="swing" axis="0 0 1"/></body>
    </worldbody><equality>)" +
         equality + "</equality></mujoco>";
}

TEST(ClosedLoops, AreClosedByTwoPointsAsByAHinge) {
  ImportOptions options;
  options.actuated = {"motor"};
  options.closure = true;
  const Imported robot =
      import_robot(mjcf_bars("<connect body1=\"coupler\" body2=\"rocker\" anchor=\"0.5 0 0\"/>"
                             "<connect body1=\"rocker\" body2=\"coupler\" anchor=\"0 0.3 0.1\"/>"),
                   "r.xml", options);
  EXPECT_THAT(robot.report(), HasSubstr("1 loop: 2 equations in as many passive joints"));
  EXPECT_THAT(robot.report(), HasSubstr("3 of 5 equations are always true and were dropped"));
}

TEST(ClosedLoops, OfJointsThatFollowTwoOthersAreRefused) {
  ImportOptions options;
  options.actuated = {"motor"};
  const std::string text = mjcf_bars(
      "<joint joint1=\"elbow\" joint2=\"motor\"/>"
      "<joint joint1=\"elbow\" joint2=\"swing\"/>");
  EXPECT_THAT([&] { static_cast<void>(import_robot(text, "r.xml", options)); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("follows two joints")));
}

}  // namespace
}  // namespace regulus::detail
