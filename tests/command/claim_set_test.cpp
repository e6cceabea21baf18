// SPDX-License-Identifier: GPL-3.0-or-later
// Every report names the set that its claim is about: ranges, what the motion fixes, constraints, limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// det = 2 − x + y²; leg 1 bears 1/(2 − x) at y = 0.
constexpr const char* kPlane = R"(regulus = 1
name = "plane"
[pose]
x = "m"
y = "m"
phi = "rad"
[geometry]
h = { value = 1, tolerance = 0.01, group = "h" }
[matrix]
rows = [["2 - x", "y"], ["-y", "h"]]
[load.pull]
wrench = [1, 0]
[actuators]
force = [-9, 9]
[motion.box]
x = [0, 1]
y = 0.25
phi = "30*deg"
[motion.path]
parameters = { T = [0, 1] }
x = "T"
y = "T^2 - 1"
phi = 0
[motion.disk]
x = [-1, 1]
y = [-1, 1]
phi = 0
constraints = ["x^2 + y^2 - 1"]
)";

class ClaimSet : public testing::Test {
 protected:
  ClaimSet() {
    std::ofstream(model_) << kPlane;
    std::ofstream(folder_.path() / "way.csv") << "x,y\n0,0\n0.5,0\n0.5,1\n";
  }

  /// Returns the report for people; `words` begin with a command and a motion.
  [[nodiscard]] std::string report(const Words& words) const {
    Words all{words[0], model_};
    all.insert(all.end(), words.begin() + 1, words.end());
    all.insert(all.end(), {"--engine", "interpreted", "--threads", "1", "--time-limit", "20"});
    const CommandResult result = regulus({}, all);
    EXPECT_LE(result.exit_code, 2) << result.errors;
    return result.errors + result.output;
  }

  [[nodiscard]] std::string way() const { return folder_.path() / "way.csv"; }

  TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "plane.toml";
};

TEST_F(ClaimSet, HasTheValuesThatTheMotionFixes) {
  const auto set = AllOf(HasSubstr("x in [0, 1] m\n"), HasSubstr("y = 0.25 m\n"),
                         HasSubstr("phi = 0.5235987755982988 rad (30 deg)\n"),
                         HasSubstr("uncertain  1 quantity: 1 of h"));
  EXPECT_THAT(report({"check", "box"}), set);
  EXPECT_THAT(report({"locate", "box"}), set);
  EXPECT_THAT(report({"check", "box", "--load", "pull"}), set);
  EXPECT_THAT(report({"bound", "box", "determinant"}), set);
  EXPECT_THAT(report({"datasheet", "box"}), set);
  EXPECT_THAT(report({"margin", "box", "--alpha", "0:"}), set);
  EXPECT_THAT(report({"margin", "box", "--scale", "0:1", "--quantity", "force", "--limit", "20"}),
              set);
}

TEST_F(ClaimSet, HasTheFormulasOfTheMotion) {
  EXPECT_THAT(report({"check", "path"}),
              AllOf(HasSubstr("T in [0, 1]\n"), HasSubstr("x = T m\n"),
                    HasSubstr("y = -1 + T^2 m\n"), HasSubstr("phi = 0 rad\n")));
}

TEST_F(ClaimSet, HasTheConstraints) {
  const auto set = HasSubstr("-1 + x^2 + y^2 <= 0\n");
  EXPECT_THAT(report({"check", "disk"}), set);
  EXPECT_THAT(report({"bound", "disk", "determinant"}), set);
}

TEST_F(ClaimSet, HasTheLimitOfTheBound) {
  const std::string told = report({"bound", "box", "force", "--limit", "5.5"});
  EXPECT_THAT(told, AllOf(HasSubstr("limit      |force under pull| < 5.5 N\n"),
                          HasSubstr("proved     |force under pull| < 5.5 N, for every pose")));
}

TEST_F(ClaimSet, SaysWhatGrows) {
  const auto grows = HasSubstr("uncertain  1 quantity: h ±v; v grows\n");
  EXPECT_THAT(report({"margin", "box", "--tolerance", "h=0:2"}),
              AllOf(HasSubstr("y = 0.25 m\n"), grows));
  EXPECT_THAT(report({"margin", "box", "--waypoints", way(), "--tolerance", "h=0:2"}), grows);
  const std::string limit = "5.5";
  EXPECT_THAT(
      report({"margin", "box", "--tolerance", "h=0:2", "--quantity", "force", "--limit", limit}),
      grows);
  EXPECT_THAT(report({"margin", "box", "--waypoints", way(), "--tolerance", "h=0:2", "--quantity",
                      "force", "--limit", limit}),
              grows);
  EXPECT_THAT(report({"margin", "box", "--tube", "x=0:2"}),
              HasSubstr("uncertain  2 quantities: h ±0.01, x_error ±v; v grows\n"));
  EXPECT_THAT(report({"margin", "box", "--grow", "x=0:3"}),
              AllOf(HasSubstr("x in [0, v] m, v grows\n"), HasSubstr("y = 0.25 m\n"),
                    Not(HasSubstr("x in [0, 1] m"))));
}

TEST_F(ClaimSet, HasTheValueThatAPoseKeepsAlongTheWay) {
  const auto set = AllOf(HasSubstr("phi = 0.5235987755982988 rad (30 deg)\n"),
                         HasSubstr("uncertain  1 quantity: 1 of h"), Not(HasSubstr("y = 0.25")));
  EXPECT_THAT(report({"check", "box", "--waypoints", way()}), set);
  EXPECT_THAT(report({"bound", "box", "determinant", "--waypoints", way()}), set);
}

TEST_F(ClaimSet, HasUnitsForPrograms) {
  const CommandResult result =
      regulus({}, {"check", model_, "box", "--waypoints", way(), "--json", "--quiet"});
  EXPECT_EQ(json::parse(result.output)["question"]["units"],
            json({{"x", "m"}, {"y", "m"}, {"phi", "rad"}, {"h", "1"}}));
}

}  // namespace
}  // namespace regulus::detail::test
