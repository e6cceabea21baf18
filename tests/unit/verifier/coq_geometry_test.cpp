// SPDX-License-Identifier: GPL-3.0-or-later
// What a theorem about the robot of a model file shows. tests/formal/geometry.cmake gives it to Coq.
#include "runtime/formal/coq_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/formal/coq_proof.hpp"
#include "runtime/formal/coq_real.hpp"

namespace regulus::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using verifier::coq_real;
using verifier::CoqRobot;

CoqRobot robot_of(const std::string& model, const std::string& parameters,
                  const std::string& alpha = "0", bool may_differ = false) {
  std::istringstream certificate(
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " +
      std::string(alpha == "0"
                      ? "the full 1x1 matrix of the model is defined and has full rank at "
                        "every pose of the variety"
                      : "the 1x1 matrix and its scales are defined and |det A * prod scale| "
                        "> alpha at every pose of the variety") +
      "\nmodel m\nsha256 -\nmotion work\nalpha " + alpha + "\n" + parameters +
      "matrix 1 1\nentry 1\nproof\n");
  CoqRobot robot;
  const verifier::CoqModel read{verifier::read_model_values(model), may_differ};
  (void)verifier::coq_proof(certificate, verifier::CoqStatement::kClaim, read, robot);
  return robot;
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
  EXPECT_THAT(robot_of(model, kParameterX, "0", true).text, HasSubstr("0 <= x <= 1."));
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
}  // namespace regulus::test
