// SPDX-License-Identifier: GPL-3.0-or-later
// What a theorem about the robot of a model file shows. tests/formal/geometry.cmake gives it to Coq.
#include "runtime/formal/coq_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/formal/coq_proof.hpp"
#include "runtime/formal/coq_real.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using verifier::coq_real;
using verifier::CoqRobot;

CoqRobot robot_with_claim(const std::string& claim, const std::string& model,
                          const std::string& lines, bool may_differ = false) {
  std::istringstream certificate("regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + claim +
                                 "\nmodel m\nsha256 -\nmotion work\n" + lines +
                                 "matrix 1 1\nentry 1\nproof\n");
  CoqRobot robot;
  const verifier::CoqModel read{verifier::read_model_values(model), may_differ};
  (void)verifier::coq_proof(certificate, verifier::CoqStatement::kClaim, read, robot);
  return robot;
}

CoqRobot robot_of(const std::string& model, const std::string& parameters,
                  bool may_differ = false) {
  return robot_with_claim(
      "the full 1x1 matrix of the model is defined and has full rank at every pose of the variety",
      model, "alpha 0\n" + parameters, may_differ);
}

std::string model_with(const std::string& gough, const std::string& motion) {
  return "[gough]\norientation = \"roll-pitch-yaw\"\n"
         "base = [[-9, 1_0, 0], [9.50, 9, 0x10], [\"2*3\", -3, 0], [3, -13, 0], [-3, -13, 0], "
         "[-12, "
         "-3, 0]]\nplatform = [[1E1, 7, 0], [3, +7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, "
         "-1, 0]]\n" +
         gough + "[motion.work]\ny = 1\nz = 2\nroll = 0\npitch = 0\nyaw = 0\n" + motion;
}

constexpr const char* kParameterX = "parameter x in 0 : 1\n";

TEST(ATheoremAboutARobot, ShowsNumbersAsTheFileWritesThem) {
  const CoqRobot robot = robot_of(model_with("", "x = [0, \"1/2\"]\n"), kParameterX);
  EXPECT_EQ(robot.reason, "");
  EXPECT_THAT(robot.text, HasSubstr("((-9, 10, 0), (1e1, 7, 0));\n   ((9.50, 9, 16), (3, 7, 0));\n "
                                    "  ((6, -3, 0), (7, -1, 0));"));
  EXPECT_THAT(robot.text, HasSubstr("0 <= x <= 1/2"));
  EXPECT_THAT(robot.text, HasSubstr("gough legs (x, 1, 2) (roll_pitch_yaw 0 0 0)"));
}

TEST(ATheoremAboutARobot, TakesNothingFromTheCertificateWithoutLeave) {
  const std::string model = model_with("", "x = [0, 7]\n");
  EXPECT_THAT(robot_of(model, kParameterX).text, HasSubstr("0 <= x <= 7"));
  EXPECT_THAT(robot_of(model, kParameterX, true).text, HasSubstr("0 <= x <= 1."));
}

TEST(ATheoremAboutARobot, HasDegreesErrorsAndTolerances) {
  const CoqRobot robot = robot_of(
      model_with("angle_unit = \"deg\"\nbase_tolerance = 0.5\ntolerance_shape = \"ball\"\n",
                 "x = [0, 1]\nerror = { yaw = 0.25 }\n"),
      kParameterX);
  EXPECT_EQ(robot.reason, "");
  EXPECT_THAT(robot.text, HasSubstr("near 0.25 0 yaw"));
  EXPECT_THAT(robot.text, HasSubstr("in_ball 0.5 (-9, 10, 0) a1"));
  EXPECT_THAT(robot.text, HasSubstr("(roll_pitch_yaw (0*deg) (0*deg) (yaw*deg))"));
  EXPECT_THAT(robot.text, HasSubstr("gough\n    [(a1, (1e1, 7, 0));"));
}

TEST(ATheoremAboutARobot, NamesAPointOnlyIfItIsInTheSet) {
  const auto text = [](const std::string& constraint) {
    return robot_of(model_with("", "x = [0, 1]\nconstraints = [\"" + constraint + "\"]\n"),
                    kParameterX)
        .text;
  };
  EXPECT_THAT(text("x - 1/2"), HasSubstr("Theorem the_set_is_inhabited"));
  EXPECT_THAT(text("x - 1/4"), Not(HasSubstr("Theorem the_set_is_inhabited")));
  EXPECT_THAT(text("x - 1/4"), HasSubstr("No point of the set is known"));
}

TEST(ATheoremAboutARobot, IsNotWrittenForWhatItDoesNotKnow) {
  const auto reason = [](const std::string& gough, const std::string& motion) {
    return robot_of(model_with(gough, motion), kParameterX).reason;
  };
  EXPECT_EQ(reason("", "x = [0, 1]\n"), "");
  EXPECT_THAT(reason("frame = 3\n", "x = [0, 1]\n"), HasSubstr("'frame' in [gough]"));
  EXPECT_THAT(reason("", "x = [0, 1]\nwhere = \"reachable\"\n"), HasSubstr("'where'"));
  EXPECT_THAT(reason("", "x = [0, 1]\nwaypoints = \"a.csv\"\n"), HasSubstr("'waypoints'"));
  EXPECT_THAT(reason("", "x = [0, 1]\nalpha = 2\n"), HasSubstr("threshold"));
  EXPECT_THAT(reason("", ""), HasSubstr("motion.work.x"));
  EXPECT_THAT(reason("", "x = [0, 1]\nerror = 0.1\n"), HasSubstr("motion.work.error"));
  EXPECT_THAT(reason("", "x = [0, 1, 2]\n"), HasSubstr("motion.work.x[2]"));
  EXPECT_THAT(reason("", "x = [0, 1]\nerror = { w = 1 }\n"), HasSubstr("motion.work.error.w"));
  EXPECT_THAT(reason("", "x = [0, 1]\nparameters = { T = 1 }\n"), HasSubstr("parameters.T"));
  EXPECT_THAT(reason("", "x = \"asin(1/2)\"\n"), HasSubstr("asin"));
  EXPECT_THAT(reason("", "x = [0, 1]\n[matrix]\nrows = [[\"x\"]]\n"), HasSubstr("[matrix]"));
  EXPECT_THAT(robot_of("[motion.work]\nx = [0, 1]\n", kParameterX).reason, HasSubstr("[gough]"));
  EXPECT_THAT(robot_of(model_with("", "x = [0, 1]\n"), "parameter w in 0 : 1\n").reason,
              HasSubstr("'w' of the certificate"));
}

constexpr const char* kMatrixFile =
    "[pose]\nx = \"m\"\nphi = \"deg\"\n[geometry]\nunused = 7\nL = { value = 1.50, tolerance = 0.1 "
    "}\n"
    "p = [3, \"2/4\"]\n[let]\nlater = \"c + p_2\"\nc = \"cos(phi)\"\nhidden = \"x\"\n"
    "[matrix]\nrows = [[\"later*L + 1\"]]\nrow_scale = [\"1/c\"]\nreduced = \"a reason\"\n";

TEST(ATheoremAboutARobot, KnowsLegsOfVariableLength) {
  const auto robot = [](const std::string& more, const std::string& leg = "") {
    return robot_of("[legs]\norientation = \"roll-pitch-yaw\"\ntype = \"UPS\"\n" + more +
                        "[[legs.leg]]\nbase = [1, 2, 3]\nplatform = [4, 5, 6]\n" + leg +
                        "[motion.work]\nx = [0, 1]\ny = 1\nz = 2\nroll = 0\npitch = 0\nyaw = 0\n",
                    kParameterX);
  };
  EXPECT_THAT(robot("range = [1, 2]\n").text, HasSubstr("[((1, 2, 3), (4, 5, 6))]."));
  EXPECT_THAT(robot("base_tolerance = 0.1\n").text, HasSubstr("in_cube 0.1 (1, 2, 3) a1"));
  EXPECT_THAT(robot("", "actuated = 1\n").reason, HasSubstr("the key legs.leg[0].actuated"));
  EXPECT_THAT(robot("rod = 3\n").reason, HasSubstr("'rod' in [legs]"));
  EXPECT_THAT(robot("[gough]\nunit = \"m\"\n").reason, HasSubstr("the table [legs]"));
}

CoqRobot robot_on_a_leg(const std::string& keys, const std::string& leg) {
  return robot_of("[legs]\norientation = \"point\"\n" + keys + "[[legs.leg]]\n" + leg +
                      "[motion.work]\nx = [0, 1]\ny = 1\nz = 2\n",
                  kParameterX);
}

TEST(ATheoremAboutLegs, RefusesWhatItHasNoWordFor) {
  const auto reason = [](const std::string& leg, const std::string& keys = "") {
    return robot_on_a_leg(keys, "base = [1, 2, 3]\n" + leg).reason;
  };
  const std::string rail = "type = \"PUS\"\nrod = 9\naxis = [0, 0, 1]\n";
  EXPECT_THAT(reason(rail), HasSubstr("another shape"));  // of the certificate's 1 x 1
  EXPECT_THAT(reason(rail + "actuated = \"none\"\n"), HasSubstr("a leg without a motor"));
  EXPECT_THAT(reason(rail + "frame = 3\n"), HasSubstr("the key legs.leg[0].frame"));
  EXPECT_THAT(reason(rail, "axis_tolerance = 0.1\n"), HasSubstr("'axis_tolerance' in [legs]"));
  EXPECT_THAT(reason("type = \"PUS\"\nrod = 9\naxis = { value = [0, 0, 1], tolerance = 1 }\n"),
              HasSubstr("a tolerance of an axis"));
  EXPECT_THAT(reason("type = \"PRS\"\nrod = 9\naxis = [0, 0, 1]\nhinge = [0, 1, 1]\n"),
              HasSubstr("a hinge that is not across the rail"));
}

TEST(ATheoremAboutAMatrix, HasTheNamesOfTheFile) {
  const CoqRobot robot = robot_with_claim(
      "the full 1x1 matrix of the model is defined and has full rank at every pose and value of "
      "the 2 uncertain quantities of the variety",
      std::string(kMatrixFile) +
          "[motion.work]\nx = [0, \"1/2\"]\nphi = 30\nerror = { x = 0.01 }\n",
      "alpha 0\nparameter x in 0 : 1/2\nconstant p_1 = 3\nconstant p_2 = 1/2\nuncertain L = 3/2 +- "
      "1/10\n"
      "pose x = x +- 1/100\npose phi = 30\n");
  EXPECT_EQ(robot.reason, "");
  EXPECT_THAT(robot.text, HasSubstr("Definition the_matrix (_L _x _phi : R) : nat -> nat -> R :=\n"
                                    "  let _p_2 := 1/2 in\n"
                                    "  let _c := cos (_phi*deg) in\n"
                                    "  let _later := _c + _p_2 in\n"
                                    "  matrix_of\n    [[_later*_L + 1]].\n"));
  EXPECT_THAT(robot.text, HasSubstr("near 0.1 1.50 _L /\\\n  0 <= _x'commanded <= 1/2 /\\\n"
                                    "  near 0.01 _x'commanded _x."));
  EXPECT_THAT(robot.text, HasSubstr("full_column_rank 1 1 (the_matrix _L _x 30)"));
}

TEST(ATheoremAboutAMatrix, HasScalesWithAThreshold) {
  const CoqRobot robot = robot_with_claim(
      "|det| of the full 1x1 matrix of the model exceeds alpha at every pose and value of the 1 "
      "uncertain quantities of the variety",
      std::string(kMatrixFile) +
          "[motion.work]\nparameters = { T = [0, 1] }\nx = \"T^2\"\nphi = \"T\"\n",
      "alpha 1/10\nparameter T in 0 : 1\nuncertain L = 3/2 +- 1/10\npose x = T^2\npose phi = T\n",
      true);
  EXPECT_EQ(robot.reason, "");
  EXPECT_THAT(robot.text,
              HasSubstr("  scaled\n    [1/_c]\n    (matrix_of\n      [[_later*_L + 1]])."));
  EXPECT_THAT(robot.text,
              HasSubstr("(1/10) < Rabs (determinant 1 (the_inverse_jacobian _L (_T^2) _T))"));
  EXPECT_THAT(robot.text, HasSubstr("  name_argument 1 as _x.\n  name_argument 0 as _phi.\n"));
}

TEST(ATheoremAboutAMatrix, IsNotWrittenForWhatItDoesNotKnow) {
  const auto reason = [](const std::string& more, const std::string& motion = "") {
    return robot_of("[pose]\nx = \"m\"\n" + more + "[motion.work]\nx = [0, 1]\n" + motion,
                    kParameterX)
        .reason;
  };
  EXPECT_EQ(reason("[matrix]\nrows = [[1]]\n"), "");
  EXPECT_THAT(reason("[matrix]\nrows = [[1]]\nframe = 3\n"), HasSubstr("'frame' in [matrix]"));
  EXPECT_THAT(reason("[matrix]\nrows = [[1], [1, 2]]\n"), HasSubstr("rows of several lengths"));
  EXPECT_THAT(reason("[matrix]\nrows = [[1], [2]]\n"), HasSubstr("another shape"));
  EXPECT_THAT(reason("[matrix]\nrows = [[\"w\"]]\n"), HasSubstr("the name w is not known"));
  EXPECT_THAT(reason("[matrix]\nrows = [[\"acos(x)\"]]\n"), HasSubstr("acos"));
  EXPECT_THAT(reason("[matrix]\nrows = [[1]]\n", "where = \"reachable\"\n"), HasSubstr("'where'"));
  EXPECT_THAT(reason("[matrix]\nrows = [[1]]\n[closure]\nunknowns = { p = 1 }\n"),
              HasSubstr("[closure]"));
  EXPECT_THAT(reason("[legs]\nleg = [{ type = \"RUT\" }]\n"),
              HasSubstr("the leg type 'RUT' is not known"));
}

TEST(AReal, HasTheParenthesesThatCoqNeeds) {
  verifier::Graph graph;
  const verifier::Scope scope{{"x", graph.add(verifier::Op::kVariable, 0)}};
  const auto text = [&](const char* expression) {
    return coq_real(graph, verifier::parse(expression, scope, graph), {"x"});
  };
  EXPECT_EQ(text("-x^2"), "-x^2");
  EXPECT_EQ(text("(-x)^2"), "(-x)^2");
  EXPECT_EQ(text("x*(-3)"), "x*(-3)");
  EXPECT_EQ(text("x - (-x)"), "x - -x");
  EXPECT_EQ(text("x - (x - 1)"), "x - (x - 1)");
  EXPECT_EQ(text("x/(x/2)"), "x/(x/2)");
  EXPECT_EQ(text("x*(1/3)"), "x*(1/3)");
  EXPECT_EQ(text("2*sin(-x)^3*pi"), "2*(sin (-x))^3*pi");
  EXPECT_EQ(text("15*(pi/180)"), "15*deg");
}

}  // namespace
}  // namespace regulus::detail::test
