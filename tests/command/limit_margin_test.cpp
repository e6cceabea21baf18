// SPDX-License-Identifier: GPL-3.0-or-later
// Tests margins of shapes, and margins within a limit, whose critical values are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// `disk` and `path`: det = 2 - x + y², singular from R = 2 on. `window`: x is in [R - 1/2, R + 1/2]
/// for an R in [0, v], singular from v = 3/2 on. `line`: leg 1 bears 1/x, leg 2 bears 3/x.
constexpr const char* kShapes = R"(regulus = 1
name = "shapes"
[pose]
x = "m"
y = "m"
[geometry]
h = { value = 1, tolerance = 0, group = "h" }
[matrix]
rows = [["2 - x", "y"], ["-y", "h"]]
[load.pull]
wrench = [1, 0]
[actuators]
stiffness = 1
[motion.disk]
parameters = { R = [0, 3] }
x = [-3, 3]
y = [-3, 3]
constraints = ["x^2 + y^2 - R^2"]
[motion.window]
parameters = { R = [0, 3] }
x = [-3, 3]
y = 0
constraints = ["(x - R)^2 - 1/4"]
[motion.path]
parameters = { T = [0, 3] }
x = "T"
y = 0
[motion.box]
x = [0, 1]
y = 0
)";

class LimitMargin : public testing::Test {
 protected:
  LimitMargin() { std::ofstream(model_) << kShapes; }

  [[nodiscard]] CommandResult margin(std::vector<std::string> words) const {
    words.insert(words.end(), {"--engine", "interpreted", "--threads", "1"});
    return regulus({"margin", model_}, words);
  }
  void expect_bracket(std::vector<std::string> words, double critical) const {
    words.insert(words.end(), {"--json", "--quiet", "--gap", "1e-4"});
    const CommandResult result = margin(words);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const json report = json::parse(result.output);
    EXPECT_LE(report["certified"], critical);
    EXPECT_GE(report["refuted"], critical);
    EXPECT_LE(report["gap"], 1e-4);
    EXPECT_TRUE(report["closed"]);
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "shapes.toml";
};

TEST_F(LimitMargin, GrowsAShape) { expect_bracket({"disk", "--grow", "R=0:3"}, 2); }

TEST_F(LimitMargin, GrowsTheRangeOfAParameterOfThePose) {
  expect_bracket({"path", "--grow", "T=0:3"}, 2);
  expect_bracket({"box", "--grow", "x=0:3"}, 2);
}

TEST_F(LimitMargin, TakesEveryValueUpToTheEndIfTheShapeMoves) {
  expect_bracket({"window", "--grow", "R=0:3"}, 1.5);
}

// F = M^-T w with M = diag(2 - x, h): the force in leg 1 is 1/(2 - x).
TEST_F(LimitMargin, KeepsALimitOfAForce) {
  expect_bracket({"box", "--grow", "x=0:1.9", "--quantity", "force", "--limit", "4"}, 1.75);
  expect_bracket({"box", "--scale", "0:3", "--quantity", "force", "--limit", "1"}, 1);
}

// The deflection of freedom 1 is 1/(2 - x)²; an expression is a quantity, too.
TEST_F(LimitMargin, KeepsALimitOfOtherQuantities) {
  expect_bracket(
      {"box", "--grow", "x=0:1.9", "--quantity", "deflection", "--freedom", "x", "--limit", "4"},
      1.5);
  expect_bracket({"disk", "--grow", "R=0:3", "--quantity", "x + y", "--limit", "1"},
                 1 / std::sqrt(2.0));
}

TEST_F(LimitMargin, GrowsATolerance) {
  expect_bracket({"box", "--tolerance", "h=0:0.9", "--quantity", "determinant", "--limit", "1/4"},
                 0.75);
}

TEST_F(LimitMargin, NamesTheComponentThatExceedsTheLimit) {
  const CommandResult result =
      margin({"box", "--grow", "x=0:1.9", "--quantity", "force", "--limit", "4"});
  EXPECT_THAT(result.output,
              testing::MatchesRegex("WITHIN UP TO 1.7.*, EXCEEDED AT 1.7.* \\(leg 1\\)\n"));
  EXPECT_THAT(result.errors, HasSubstr("exceeded   leg 1: x = 1.7"));
}

TEST_F(LimitMargin, ProvesBothEndsByCertificates) {
  const std::string file = directory_.path() / "proof";
  ASSERT_EQ(margin({"disk", "--grow", "R=0:3", "--quantity", "determinant", "--limit", "1/10",
                    "--certificate", file})
                .exit_code,
            0);
  for (const char* end : {".safe", ".singular"}) {
    const CommandResult verified = run_command({kVerify, file + end});
    EXPECT_EQ(verified.exit_code, 0) << end << verified.errors;
  }
}

TEST_F(LimitMargin, RefusesWhatHasNoMeaning) {
  const auto refused = [this](std::vector<std::string> words, const char* why) {
    const CommandResult result = margin(std::move(words));
    EXPECT_EQ(result.exit_code, 64) << result.output;
    EXPECT_THAT(result.errors, HasSubstr(why));
  };
  refused({"disk", "--grow", "Q=0:3"}, "the motion 'disk' has no parameter 'Q' with a range");
  refused({"path", "--grow", "T"}, "--grow");
  refused({"disk", "--grow", "R=0:3", "--scale", "0:1"}, "2 options have a range LO:HI");
  refused({"disk", "--grow", "R=0:3", "--quantity", "force"}, "need each other");
  refused({"disk", "--grow", "R=0:3", "--limit", "2"}, "need each other");
  refused({"disk", "--alpha", "0:3", "--quantity", "force", "--limit", "2"}, "--alpha");
  refused({"disk", "--grow", "R=0:3", "--quantity", "force", "--limit", "-2"},
          "expected a positive number");
  refused({"disk", "--grow", "R=0:3", "--quantity", "torque", "--limit", "2"}, "QUANTITY");
}

TEST_F(LimitMargin, RefusesAStartBelowTheDeclaredRange) {
  std::ofstream(model_, std::ios::app) << "[motion.far]\nx = [1, 1.5]\ny = 0\n";
  const CommandResult result = margin({"far", "--grow", "x=0.5:1.5"});
  EXPECT_EQ(result.exit_code, 64);
  EXPECT_THAT(result.errors, HasSubstr("LO is 0.5, below the range of 'x', which begins at 1"));
}

}  // namespace
}  // namespace regulus::detail::test
