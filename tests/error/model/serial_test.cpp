// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;

const std::string kArm =
    "regulus = 1\n"
    "name = \"arm\"\n"
    "[serial]\n"
    "joints = [\n"
    "  { name = \"q1\" },\n"
    "  { name = \"q2\", xyz = [1, 0, 0], rpy = [0, 0, 0], axis = [0, 1, 0] },\n"
    "]\n"
    "[motion.zero]\n"
    "q1 = 0\n"
    "q2 = 0\n";

void expect_refused_arm(const std::string& from, const std::string& to, int line,
                        const std::string& found, const std::string& expected) {
  expect_refused(changed(kArm, from, to), line, found, expected);
}

TEST(SerialRefusal, TogetherWithPoseOrMatrixOrGough) {
  expect_refused(kArm + "[pose]\nx = \"m\"\n", 11, "[pose] cannot be used together with [serial]",
                 "remove one of them");
  expect_refused(kArm + "[matrix]\nrows = [[1]]\n", 11, "[matrix] cannot be used together",
                 "remove one of them");
  expect_refused(kArm + "[gough]\n", 3, "[serial] cannot be used together with [gough]",
                 "remove one of them");
}

TEST(SerialRefusal, ErrorsOfATool) {
  const std::string tool = "[motion.tool]\ntool = [1, 0, 0, 0, 0, 0]\n";
  expect_refused(kArm + tool + "error = { q1 = 0.1 }\n", 13, "unknown key 'motion.tool.error.q1'",
                 "x, y, z, roll, pitch");
  expect_refused(kArm + tool + "error = { x = -0.1 }\n", 13, "the negative number", "a number ≥ 0");
  expect_refused(kArm + tool + "error = 0.1\n", 13, "a number for motion.tool.error", "a table");
  expect_refused(kArm + tool + "alpha = 0\n", 13, "has no 'alpha'", "remove one of them");
}

TEST(SerialRefusal, UnknownKeysAndWords) {
  expect_refused_arm("xyz =", "xzy =", 6, "unknown key 'serial.joints[2].xzy'", "'xyz'");
  expect_refused_arm("axis = [0, 1, 0]", "type = \"hinge\"", 6, "the string 'hinge'",
                     "\"revolute\", \"continuous\", \"prismatic\" or \"fixed\"");
  expect_refused_arm("[serial]\n", "[serial]\nconvention = \"dh\"\n", 4, "the string 'dh'",
                     "\"origins\", \"standard-dh\" or \"modified-dh\"");
}

TEST(SerialRefusal, AKeyOfAnotherConvention) {
  expect_refused_arm("[serial]\n", "[serial]\nconvention = \"standard-dh\"\n", 7,
                     "unknown key 'serial.joints[2].xyz'", "alpha");
}

TEST(SerialRefusal, AJointThatFollowsWrongly) {
  const std::string second = "{ name = \"q2\",";
  expect_refused_arm(second, "{ mimic = \"q3\",", 6, "no joint of the list has the name 'q3'",
                     "follows no other");
  expect_refused_arm(second, "{ mimic = \"q1\", name = \"q2\",", 6, "has no name", "remove it");
  expect_refused_arm(second, "{ mimic = \"q1\", range = [0, 1],", 6, "has no range", "remove it");
  expect_refused_arm(second, "{ name = \"q2\", multiplier = 2,", 6, "multiplier without mimic",
                     "mimic = ");
  expect_refused_arm(second, "{ type = \"fixed\", mimic = \"q1\",", 6, "a fixed joint has no mimic",
                     "remove it");
  expect_refused(changed(changed(kArm, "{ name = \"q1\" }", "{ mimic = \"q2\" }"), second,
                         "{ mimic = \"q1\","),
                 5, "no joint of the list has the name 'q2'", "follows no other");
}

TEST(SerialRefusal, WrongNumbersOfCoordinates) {
  expect_refused_arm("[1, 0, 0]", "[1, 0]", 6, "2 numbers in serial.joints[2].xyz", "3 numbers");
}

TEST(SerialRefusal, AnAxisWithoutDirection) {
  expect_refused_arm("axis = [0, 1, 0]", "axis = [0, 0, 0]", 6, "is zero", "have a direction");
  expect_refused_arm("axis = [0, 1, 0]", "axis = [0, \"sqrt(2)*sqrt(3) - sqrt(6)\", 0]", 6,
                     "is zero, or cannot be told from zero", "have a direction");
}

TEST(SerialRefusal, TwoOrientations) {
  expect_refused_arm("rpy = [0, 0, 0]", "rpy = [0, 0, 0], quaternion = [1, 0, 0, 0]", 6,
                     "more than one orientation", "keep one");
}

TEST(SerialRefusal, AMatrixThatIsNoRotation) {
  expect_refused_arm("rpy = [0, 0, 0]", "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]", 6,
                     "not proved to be a rotation", "exact");
  expect_refused_arm("rpy = [0, 0, 0]",
                     "rotation = [[0.707, -0.707, 0], [0.707, 0.707, 0], [0, 0, 1]]", 6,
                     "not proved to be a rotation", "exact");
}

TEST(SerialRefusal, JointsWithoutNames) {
  expect_refused_arm("name = \"q2\", ", "", 6, "there is no 'name' in serial.joints[2]",
                     "add 'serial.joints[2].name'");
  expect_refused_arm("\"q2\"", "\"q1\"", 6, "'q1' is declared twice", "choose another name");
  expect_refused_arm("\"q2\"", "\"alpha\"", 6, "which is a key of motions", "choose another name");
}

TEST(SerialRefusal, NoJointThatMovesAndTooMany) {
  expect_refused_arm("{ name = \"q1\" },\n  { name = \"q2\", ",
                     "{ type = \"fixed\" },\n  { type = \"fixed\", ", 4, "no joint that moves",
                     "at least one");
  std::string many;
  for (int j = 3; j < 20; ++j) many += "  { name = \"q" + std::to_string(j) + "\" },\n";
  expect_refused_arm("]\n[motion", many + "]\n[motion", 4, "19 joints that move", "at most 12");
}

TEST(SerialRefusal, RangesOfSomeJointsOnly) {
  expect_refused_arm("{ name = \"q1\" }", "{ name = \"q1\", range = [0, 1] }", 4,
                     "only some joints have a range", "every joint");
  expect_refused_arm("{ name = \"q1\" }", "{ name = \"q1\", range = [1, 0] }", 5, "range",
                     "its lower end must not be above");
}

TEST(SerialRefusal, AMotionOfTheNameOfTheRanges) {
  const std::string arm =
      changed(changed(kArm, "{ name = \"q1\" }", "{ name = \"q1\", range = [0, 1] }"),
              "name = \"q2\"", "name = \"q2\", range = [0, 1]");
  expect_refused(changed(arm, "[motion.zero]", "[motion.limits]"), 8,
                 "already make a motion 'limits'", "choose another name");
}

/// A turn by angles whose sines and cosines are no roots multiplies the terms.
TEST(SerialRefusal, AMatrixOfTooManyTerms) {
  std::string fixed;
  for (int i = 0; i < 30; ++i)
    fixed += "  { type = \"fixed\", rpy = [0." + std::to_string(i + 1) + ", 0.0" +
             std::to_string(i + 3) + ", 0.5" + std::to_string(i) + "] },\n";
  expect_refused_arm("  { name = \"q2\"", fixed + "  { name = \"q2\"", 3, "terms in one entry",
                     "quaternion");
}

TEST(SerialRefusal, TolerancesThatDoNotReachAValue) {
  const std::string head = "regulus = 1\nname = \"arm\"\n[serial]\n";
  const std::string zero = "[motion.zero]\nq1 = 0\nq2 = 0\n";
  const std::string arm = "joints = [{ name = \"q1\" }, { name = \"q2\", xyz = [1, 0, 0] }]\n";
  expect_refused(head + "angle_tolerance = 0.1\n" + arm + zero, 4,
                 "serial.angle_tolerance applies to nothing", "remove it");
  expect_refused(
      head + "length_tolerance = 0.1\njoints = [{ name = \"q1\" }, { name = \"q2\" }]\n" + zero, 4,
      "serial.length_tolerance applies to nothing", "remove it");
  expect_refused(head +
                     "angle_tolerance = 0.1\njoints = [{ name = \"q1\" },\n{ name = \"q2\", "
                     "quaternion = [1, 0, 0, 0] }]\n" +
                     zero,
                 6, "angle_tolerance does not apply", "write the orientation as rpy");
  expect_refused(head +
                     "angle_tolerance = 0.1\njoints = [{ name = \"q1\" }, { name = \"q2\" },\n"
                     "{ mimic = \"q1\", offset = 1, rpy = [1, 0, 0] }]\n" +
                     zero,
                 6, "serial.angle_tolerance does not apply to", "a part of the joint's place");
}

TEST(SerialRefusal, NamesOfRadiansAmongDegrees) {
  expect_refused(
      "regulus = 1\nname = \"arm\"\n[geometry]\nA = \"90deg\"\n[serial]\nangle_unit = "
      "\"deg\"\nconvention = \"standard-dh\"\njoints = [{ name = \"q1\", a = 1, alpha = "
      "\"A\" }]\n[motion.zero]\nq1 = 0\n",
      8, "is a number of degrees", "numbers of degrees, too");
}

}  // namespace
}  // namespace regulus::detail
