// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes for which a robot in C++ is refused; the message names the line of C++.
#include "codegen/model/robot/robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// A change to a valid robot, and the line of that change.
struct Mistake {
  std::function<void(Robot&)> make;
  std::string found, expected;
  int line;
};

Robot valid() {
  Robot robot("valid");
  const Formula x = robot.pose("x"), y = robot.pose("y");
  robot.uncertain("height", "1/3", "0.01", "base");
  robot.matrix({{x, y}, {y, x}});
  return robot;
}

void expect_refused(const Mistake& mistake) {
  Robot robot = valid();
  try {
    mistake.make(robot);
    static_cast<void>(robot.model());
    ADD_FAILURE() << "accepted; expected: found " << mistake.found;
  } catch (const InputError& error) {
    EXPECT_THAT(error.file(), testing::EndsWith("robot_test.cpp"));
    EXPECT_EQ(error.line(), mistake.line) << error.what();
    EXPECT_THAT(error.found(), testing::HasSubstr(mistake.found));
    EXPECT_THAT(error.expected(), testing::HasSubstr(mistake.expected));
  }
}

void box(Robot& robot) { robot.motion("box").range("x", 0, 1).range("y", 0, 1); }

TEST(RobotErrors, TheExampleIsValidWithAMotion) {
  Robot robot = valid();
  box(robot);
  EXPECT_NO_THROW(static_cast<void>(robot.model()));
}

TEST(RobotErrors, AnUndeclaredSymbolIsNamedWithTheOneThatMayBeMeant) {
  expect_refused({[](Robot& r) {
                    box(r);
                    r.row_scale({"1/(1 + heigth^2)", 1});
                  },
                  "'heigth'", "'height'", __LINE__ - 2});
}

TEST(RobotErrors, AMatrixOfAnotherShapeIsRefusedWhereItIsGiven) {
  Robot robot("wide");
  robot.pose("x");
  robot.motion("m").range("x", 0, 1);
  const int line = __LINE__ + 1;
  robot.matrix({{"x", 1}});
  try {
    static_cast<void>(robot.model());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), line);
    EXPECT_THAT(error.found(), testing::HasSubstr("1 rows of 2 entries"));
  }
}

TEST(RobotErrors, AnEmptyRangeIsRefused) {
  expect_refused({[](Robot& r) { r.motion("m").pose("y", 0).range("x", 1, 0); }, "is empty",
                  "lower end", __LINE__ - 1});
}

TEST(RobotErrors, APoseParameterWithoutARangeIsRefused) {
  expect_refused(
      {[](Robot& r) { r.motion("m").range("x", 0, 1); }, "no 'y'", "'motion.m.y'", __LINE__});
}

TEST(RobotErrors, ANegativeToleranceIsRefused) {
  expect_refused({[](Robot& r) {
                    box(r);
                    r.uncertain("g", 1, "-0.1");
                  },
                  "the negative number", "a number", __LINE__ - 2});
}

TEST(RobotErrors, ANameThatIsDeclaredTwiceIsRefusedByTheSecondCall) {
  expect_refused(
      {[](Robot& r) { r.let("x", 1); }, "'x' is declared twice", "another name", __LINE__});
  expect_refused({[](Robot& r) {
                    box(r);
                    box(r);
                  },
                  "'box' is declared twice", "another name", 44});
  expect_refused({[](Robot& r) { r.motion("m").range("x", 0, 1).pose("x", 0); }, "given twice",
                  "once", __LINE__ - 1});
}

TEST(RobotErrors, WhatIsNoNameIsRefused) {
  expect_refused({[](Robot& r) { r.pose("no name"); }, "'no name'", "a letter", __LINE__});
  expect_refused({[](Robot& r) { r.let("sin", 1); }, "'sin'", "another name", __LINE__});
}

TEST(RobotErrors, TextThatIsNoExpressionIsRefusedWhereItIsWritten) {
  expect_refused({[](Robot& r) { r.let("u", Formula("1) + (2") * 3); }, "')'", "", __LINE__});
  expect_refused({[](Robot& r) { r.let("u", "x +"); }, "the end", "", __LINE__});
}

TEST(RobotErrors, ARoundedNumberOfGiNaCIsRefused) {
  expect_refused({[](Robot& r) { r.let("u", Formula(GiNaC::numeric(0.1))); },
                  "floating-point number 0.1", "\"0.1\"", __LINE__ - 1});
}

TEST(RobotErrors, ASymbolOfGiNaCThatIsAnotherOfTheSameNameIsRefused) {
  expect_refused({[](Robot& r) {
                    const GiNaC::realsymbol another("x");
                    r.let("u", another * another);
                    box(r);
                  },
                  "the GiNaC symbol 'x'", "another symbol of the same name", __LINE__ - 3});
}

TEST(RobotErrors, AnExpressionThatDoublesWithEachStepIsRefused) {
  const auto doubling = [] {
    Formula x = "x";
    for (int i = 0; i < 100; ++i) x = x * x + x;
  };
  EXPECT_THAT(doubling, testing::ThrowsMessage<InputError>(testing::HasSubstr("Robot::let")));
}

}  // namespace
}  // namespace regulus::detail
