// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/robot/robot.hpp"

#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/example_model.hpp"
#include "tests/support/model_text.hpp"

namespace regulus::detail::robot_test {
namespace {

/// The example of the model files in C++, with every feature of the format.
Robot example() {
  Robot robot("example");
  robot.source("made up");
  const Formula x = robot.pose("x", "cm"), y = robot.pose("y", "cm"),
                phi = robot.pose("phi", "rad");
  const Formula a2 = robot.constant("a2", 10);
  const Formula h = robot.uncertain("h", "1/3", "0.01");
  const Formula r = robot.uncertain("r", 4, "0.05", "platform");
  const auto p1 = robot.ball("p1", {3, 7, 0}, "0.05", "base");
  const auto p2 = robot.point("p2", {"0.1", Formula(1) / 7}, "1/100", "base");
  const Formula c = robot.let("c", cos(phi));
  const Formula rho_1 = robot.let("rho_1", sqrt(pow(x - h * c, 2) + pow(y, 2) + 1));
  const Formula rho_2 = robot.let("rho_2", sqrt(pow(x - a2, 2) + pow(y, 2)));
  const Formula half = robot.let("half", "0.5");
  robot.matrix({{x - h * c, y, 1},
                {x - a2, y, c},
                {p1[0] * x, y - r, half * p2[1]},
                {1, "2.5", p1[1] + p1[2] + p2[0]}});
  robot.row_scale({1 / rho_1, 1 / rho_2, 2, "1/3"});
  robot.motion("small")
      .range(x, -1, 1)
      .range(y, 4, 5)
      .range(phi, "-10*deg", "10*deg")
      .constraint(pow(x, 2) + pow(y, 2) - 25)
      .constraint(rho_2 - 20)
      .alpha(0);
  RobotMotion& circle = robot.motion("circle");
  const Formula T = circle.parameter("T", 0, 1);
  circle.pose(x, cos(2 * Formula("pi") * T)).pose(y, 5 + sin(2 * Formula("pi") * T)).pose(phi, 0);
  circle.error(x, "0.01").error(phi, "0.1*deg");
  return robot;
}

TEST(Robot, SaysWhatTheModelFileOfTheSameRobotSays) {
  EXPECT_EQ(test::everything_of(example().model()),
            test::everything_of(parse_model(test::kExample, "m.toml")));
}

TEST(Robot, IsWrittenAsAModelFileOfTheSameModel) {
  const Robot robot = example();
  const Model read = parse_model(robot.model_file(), "written.toml");
  EXPECT_EQ(test::everything_of(read), test::everything_of(robot.model()));
  EXPECT_EQ(read.sha256, robot.model().sha256);
}

TEST(Robot, MayBeCopiedAndGoOnWithItsMotions) {
  Robot robot = example();
  Robot copy = robot;
  copy.motion("more").range("x", 0, 1).pose("y", 0).pose("phi", 0);
  EXPECT_EQ(robot.model().motions.size(), 2U);
  EXPECT_EQ(copy.model().motions.size(), 3U);
}

TEST(Robot, KeepsWhatMustBeDefinedAsItWasWritten) {
  Robot robot("r");
  const Formula x = robot.pose("x");
  robot.matrix({{1 + (x - x) / x}});  // GiNaC alone would say 1
  robot.motion("m").range(x, -1, 1);
  const Model model = robot.model();
  EXPECT_TRUE(model.matrix(0, 0).is_equal(1));
  ASSERT_EQ(model.must_be_defined.size(), 1U);
  EXPECT_TRUE(model.must_be_defined[0].is_equal(1 / model.pose[0].symbol));
}

TEST(Robot, TakesAMatrixOfGiNaC) {
  const GiNaC::realsymbol x("x"), y("y"), h("h"), T("T");
  Robot robot("r");
  robot.pose(x, "cm");
  robot.pose(y);
  robot.uncertain(h, GiNaC::numeric(1, 3), GiNaC::numeric(1, 100), "g");
  GiNaC::matrix J{{x - h * cos(y), sqrt(x * x + 1)}, {GiNaC::Pi * y, GiNaC::numeric(1, 10)}};
  robot.matrix(J);
  RobotMotion& line = robot.motion("line");
  line.parameter(T, 0, 1);
  line.pose("x", T * T).pose("y", 1 - T).constraint(T * h - 1);
  const Model model = robot.model();
  const GiNaC::exmap own{{x, model.pose[0].symbol},
                         {y, model.pose[1].symbol},
                         {h, model.geometry[0].symbol},
                         {T, model.motions[0].parameters[0].symbol}};
  for (unsigned i = 0; i < 2; ++i)
    for (unsigned j = 0; j < 2; ++j)
      EXPECT_TRUE(model.matrix(i, j).is_equal(J(i, j).subs(own))) << J(i, j);
  EXPECT_TRUE(model.geometry[0].tolerance.is_equal(GiNaC::numeric(1, 100)));
  EXPECT_TRUE(model.motions[0].pose[0].is_equal(GiNaC::ex(T * T).subs(own)));
}

TEST(Robot, WritesLabelsThatTomlWouldMisread) {
  Robot robot("a \"quoted\" name = [1]");
  robot.source("größer");
  const Formula x = robot.pose("x", "#");
  robot.matrix({{x}});
  robot.motion("m").range(x, 1, 2);
  EXPECT_EQ(robot.model().name, "a \"quoted\" name = [1]");
  EXPECT_EQ(robot.model().source, "größer");
  EXPECT_EQ(robot.model().pose[0].unit, "#");
}

}  // namespace
}  // namespace regulus::detail::robot_test
