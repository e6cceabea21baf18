// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;

const std::string kRobot =
    "regulus = 1\n"
    "name = \"robot\"\n"
    "[legs]\n"
    "crank = 1\n"
    "rod = 2\n"
    "mode = \"+\"\n"
    "[[legs.leg]]\n"
    "type = \"RRR\"\n"
    "base = [0, 0]\n"
    "platform = [0, 0]\n"
    "[[legs.leg]]\n"
    "type = \"RPR\"\n"
    "base = [1, 0]\n"
    "platform = [1, 0]\n"
    "[[legs.leg]]\n"
    "type = \"PRR\"\n"
    "base = [0, 1]\n"
    "platform = [0, 1]\n"
    "axis = [1, 0]\n"
    "[motion.zero]\n"
    "x = 0\n"
    "y = 0\n"
    "phi = 0\n";

void expect_refused_robot(const std::string& from, const std::string& to, int line,
                          const std::string& found, const std::string& expected) {
  expect_refused(changed(kRobot, from, to), line, found, expected);
}

TEST(LegsRefusal, TogetherWithPoseMatrixOrSerial) {
  expect_refused(kRobot + "[pose]\nx = \"m\"\n", 24, "[pose] cannot be used together with [legs]",
                 "remove one of them");
  expect_refused(kRobot + "[matrix]\nrows = [[1]]\n", 24, "[matrix] cannot be used together",
                 "remove one of them");
  expect_refused(kRobot + "[serial]\n", 3, "[legs] cannot be used together with [serial]",
                 "remove one of them");
}

TEST(LegsRefusal, UnknownKeysTypesAndModes) {
  expect_refused_robot("axis = [1, 0]", "axes = [1, 0]", 19, "unknown key 'legs.leg[3].axes'",
                       "'axis'");
  expect_refused_robot("\"RPR\"", "\"RPX\"", 12, "the string 'RPX'", "\"UPS\"");
  expect_refused_robot("mode = \"+\"", "mode = \"up\"", 6, "the string 'up'", "\"+\" or \"-\"");
}

TEST(LegsRefusal, KeysThatALegDoesNotHave) {
  expect_refused_robot("platform = [1, 0]\n", "platform = [1, 0]\nrod = 3\n", 15,
                       "a leg RPR has no rod", "remove it");
  expect_refused_robot("base = [0, 0]\n", "base = [0, 0]\naxis = [0, 1]\n", 10,
                       "a leg RRR has no axis", "remove it");
}

TEST(LegsRefusal, MissingGeometry) {
  expect_refused_robot("axis = [1, 0]\n", "", 15, "there is no 'axis' in legs.leg[3]", "add");
  expect_refused_robot("crank = 1\n", "", 6, "there is no 'crank' in legs.leg[1]", "add");
  expect_refused_robot("platform = [0, 0]\n", "", 7, "there is no 'platform' in legs.leg[1]",
                       "add");
  expect_refused_robot("base = [0, 0]", "base = [0, 0, 0]", 9, "3 numbers in legs.leg[1].base",
                       "2 numbers");
}

TEST(LegsRefusal, LengthsThatAreNotPositive) {
  expect_refused_robot("crank = 1", "crank = 0", 4, "a length that is not positive", "positive");
  expect_refused_robot("rod = 2", "rod = -2", 5, "a length that is not positive", "positive");
}

TEST(LegsRefusal, AnAxisWithoutDirection) {
  expect_refused_robot("axis = [1, 0]", "axis = [0, 0]", 19, "is zero", "have a direction");
}

TEST(LegsRefusal, AHingeAlongTheRail) {
  const std::string robot =
      "regulus = 1\nname = \"robot\"\n[legs]\norientation = \"euler-zxz\"\n[[legs.leg]]\n"
      "type = \"PRS\"\nbase = [0, 0, 0]\nplatform = [0, 0, 0]\naxis = [1, 1, 0]\nrod = 1\n"
      "mode = \"+\"\nhinge = [1, 0, 0]\n[motion.zero]\nx = 0\n";
  expect_refused(robot, 12, "not shown to be across its rail", "correct hinge or axis");
  expect_refused(changed(robot, "hinge = [1, 0, 0]\n", ""), 5, "there is no 'hinge'", "add");
  expect_refused(changed(robot, "PRS", "PUS"), 12, "a leg PUS has no hinge", "remove it");
  expect_refused_robot("base = [0, 0]\n", "base = [0, 0]\nhinge = [0, 1]\n", 10,
                       "a leg RRR has no hinge", "remove it");
}

TEST(LegsRefusal, LegsInThePlaneAndInSpace) {
  expect_refused_robot("\"PRR\"", "\"UPS\"", 16, "a leg UPS in space beside a leg RRR in the plane",
                       "legs of one kind");
}

TEST(LegsRefusal, JointsThatCannotBeDriven) {
  expect_refused_robot("axis = [1, 0]", "axis = [1, 0]\nactuated = 4", 20, "the integer 4",
                       "1, 2 or 3 from the base");
  expect_refused_robot("axis = [1, 0]", "axis = [1, 0]\nactuated = \"P\"", 20, "the string 'P'",
                       "\"none\"");
}

TEST(LegsRefusal, TooFewMotors) {
  expect_refused_robot("axis = [1, 0]", "axis = [1, 0]\nactuated = \"none\"", 3,
                       "fewer than the 3 freedoms of the platform", "drive more");
}

TEST(LegsRefusal, ALevelPlatformThatTurns) {
  const std::string robot =
      "regulus = 1\nname = \"robot\"\n[legs]\norientation = \"euler-zxz\"\n[[legs.leg]]\n"
      "type = \"UPU\"\nbase = [0, 0, 0]\nplatform = [0, 0, 0]\naxis = [1, 0, 0]\n"
      "[motion.zero]\nx = 0\n";
  expect_refused(robot, 5, "a leg UPU keeps the platform from turning", "orientation = \"fixed\"");
  expect_refused(changed(robot, "orientation = \"euler-zxz\"\n", ""), 3,
                 "there is no 'orientation'", "add");
}

TEST(LegsRefusal, RangesThatSayNothing) {
  expect_refused_robot("axis = [1, 0]", "axis = [1, 0]\nrange = [2, 1]", 20, "range",
                       "its lower end must not be above");
  expect_refused_robot("platform = [1, 0]", "platform = [1, 0]\nrange = [-1, 1]", 15, "-1", "0");
  expect_refused_robot("platform = [0, 0]", "platform = [0, 0]\nrange = [-4, 4]", 11,
                       "not shown to be less than a turn", "needs no range");
}

TEST(LegsRefusal, AMotionWithinRangesThatNoLegHas) {
  expect_refused(kRobot + "where = \"within-ranges\"\n", 24, "no actuated joint has a range",
                 "give legs a range");
  expect_refused(kRobot + "where = \"here\"\n", 24, "the string 'here'",
                 "\"reachable\" or \"within-ranges\"");
}

TEST(LegsRefusal, ANameThatALegHas) {
  expect_refused_robot("[legs]\n", "[geometry]\ne1_x = 1\n[legs]\n", 5, "'e1_x' is declared twice",
                       "choose another name");
}

TEST(LegsRefusal, LengthsThatAreNotPositiveHoweverTheyAreWritten) {
  for (const char* text : {"crank = -1", "crank = \"-1\"", "crank = \"L\"", "crank = \"2*L + 1\"",
                           "crank = \"L*cos(0)\"", "crank = \"L + 1\""}) {
    const std::string model = changed(kRobot, "crank = 1", text) + "[geometry]\nL = -1\n";
    expect_refused(model, 4, "a length that is not positive", "a rod has a positive length");
    expect_refused(changed(model, "L = -1", "L = { value = -1, tolerance = 0.1 }"), 4,
                   "a length that is not positive", "a rod has a positive length");
  }
}

TEST(LegsRefusal, PartsThatDependOnThePoseOrHaveNoValue) {
  expect_refused_robot("base = [1, 0]", "base = [\"x\", 0]", 13, "depends on the pose",
                       "constants of [geometry]");
  expect_refused_robot("crank = 1", "crank = \"1 + r11\"", 4, "depends on the pose",
                       "constants of [geometry]");
  const std::string model = changed(kRobot, "crank = 1", "crank = \"1/(L - 2)\"");
  expect_refused(model + "[geometry]\nL = 2\n", 4, "has no value", "correct the expression");
  expect_refused(changed(model, "1/(L - 2)", "sqrt(-L)") + "[geometry]\nL = 2\n", 4, "has no value",
                 "correct the expression");
}

TEST(LegsRefusal, TolerancesOfWhatNoLegHas) {
  const std::string legs =
      "[legs]\n[[legs.leg]]\ntype = \"RPR\"\nbase = [0, 0]\nplatform = [0, 0]\n";
  for (const char* key : {"crank_tolerance", "rod_tolerance", "axis_tolerance"})
    expect_refused("regulus = 1\nname = \"robot\"\n" +
                       changed(legs, "[legs]\n", std::string("[legs]\n") + key + " = 0.1\n"),
                   4, std::string("legs.") + key + " applies to nothing", "remove it");
}

}  // namespace
}  // namespace regulus::detail
