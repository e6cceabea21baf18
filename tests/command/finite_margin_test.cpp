// SPDX-License-Identifier: GPL-3.0-or-later
// Tests how far errors can grow while what they move keeps a limit, against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::finite_margin_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// q = sqrt(c·l) at l = 4 and c = 1: errors within ± v of l move it by at most 2 - sqrt(4 - v), and
/// those of c by 2 - 2·sqrt(1 - v).
constexpr const char* kRoot = R"(regulus = 1
name = "root"
[pose]
l = "m"
[geometry]
c = { value = 1, tolerance = 0, group = "factor" }
[closure]
unknowns = { q = "m" }
equations = ["q^2 - c*l"]
start = { l = 4, q = 2 }
[motion.rest]
l = 4
)";

const std::string kOctahedral = std::string(REGULUS_SOURCE_DIR) + "/models/octahedral.toml";

constexpr const char* kTriangle = R"toml(regulus = 1
name = "triangle"
[legs]
unit = "cm"
[[legs.leg]]
type = "RPR"
base = [0, 10]
platform = [0, 4]
[[legs.leg]]
type = "RPR"
base = ["-5*sqrt(3)", -5]
platform = ["-2*sqrt(3)", -2]
[[legs.leg]]
type = "RPR"
base = ["5*sqrt(3)", -5]
platform = ["2*sqrt(3)", -2]
[motion.rest]
x = 0
y = 0
phi = "60*deg"
)toml";

class FiniteMargin : public testing::Test {
 protected:
  FiniteMargin() { std::ofstream(model_) << kRoot; }

  [[nodiscard]] static CommandResult margin(const std::string& model,
                                            std::vector<std::string> words) {
    for (const char* word : {"--quantity", "error", "--finite", "--threads", "1", "--quiet"})
      words.emplace_back(word);
    return regulus({"margin", model}, words);
  }

  static void expect_bracket(const std::string& model, std::vector<std::string> words,
                             double critical, const char* gap = "1e-2", double slack = 0) {
    words.insert(words.end(), {"--json", "--gap", gap});
    const CommandResult result = margin(model, words);
    ASSERT_EQ(result.exit_code, 0) << result.output << result.errors;
    const json report = json::parse(result.output);
    EXPECT_LE(report["certified"], critical);
    EXPECT_GE(report["refuted"], critical * (1 - slack));
    EXPECT_TRUE(report["closed"]) << result.output;
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "root.toml";
};

TEST_F(FiniteMargin, GrowsAControlError) {
  expect_bracket(model_, {"rest", "--tube", "l=0:3", "--limit", "1/2"}, 1.75);
}

TEST_F(FiniteMargin, GrowsATolerance) {
  expect_bracket(model_, {"rest", "--tolerance", "factor=0:1/2", "--limit", "1/2"}, 0.4375);
}

// Legs from a triangle of radius 10 to one of radius 4 inside it, which is turned by a sixth of a turn:
// ρ² = 116 - 80·cos(angle). If all are longer by v or shorter by v it turns, and by symmetry the
// derivatives of its angle by the three lengths are equal.
TEST_F(FiniteMargin, GrowsErrorsOfThePlatformsLegs) {
  const double half = std::acos(-1.0) / 6, moved = 0.02;
  std::ofstream(model_) << kTriangle;
  const auto length = [](double angle) { return std::sqrt(116 - 80 * std::cos(angle)); };
  const double critical = std::min(length(2 * half) - length(2 * half - moved),
                                   length(2 * half + moved) - length(2 * half));
  expect_bracket(model_,
                 {"rest", "--tube", "leg_1,leg_2,leg_3=0:0.2", "--freedom", "phi_deviation",
                  "--limit", "0.02"},
                 critical, "1e-2", 1e-3);
}

// The verifier is told that a tolerance is an option's.
TEST_F(FiniteMargin, ProvesBothEnds) {
  const std::string file = directory_.path() / "proof";
  const CommandResult result = margin(
      model_, {"rest", "--tolerance", "factor=0:1/2", "--limit", "1/2", "--certificate", file});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  for (const char* end : {".q.safe", ".q.singular"}) {
    const CommandResult plain = run_command({kVerify, file + end, "--model", model_});
    EXPECT_EQ(plain.exit_code, 1) << end << plain.output << plain.errors;
    const CommandResult told =
        run_command({kVerify, file + end, "--model", model_, "--allow-options"});
    EXPECT_EQ(told.exit_code, 0) << end << told.output << told.errors;
  }
}

TEST_F(FiniteMargin, StandsInADatasheetWhereThereAreErrors) {
  std::ofstream(model_, std::ios::app) << "error = { l = 0.5 }\n";
  const CommandResult sheet =
      regulus({"datasheet", model_}, {"rest", "--json", "--quiet", "--threads", "1"});
  ASSERT_EQ(sheet.exit_code, 0) << sheet.errors;
  const double moved = 2 - std::sqrt(3.5);
  std::size_t rows = 0;
  const json report = json::parse(sheet.output);
  for (const json& bound : report.at("bounds")) {
    if (bound.at("quantity").at("kind") != "finite-error") continue;
    for (const json& row : bound.at("components")) {
      ++rows;
      EXPECT_LE(row.at("attained"), moved);
      EXPECT_GE(row.at("proved"), moved);
    }
  }
  EXPECT_EQ(rows, 1) << sheet.output;
}

TEST_F(FiniteMargin, RefusesErrorsThatDoNotCount) {
  const auto refused = [](const CommandResult& result, const char* why) {
    EXPECT_EQ(result.exit_code, 64) << result.output;
    EXPECT_THAT(result.errors, HasSubstr(why));
  };
  refused(margin(kOctahedral, {"level_89", "--tube", "x=0:0.1", "--limit", "0.05"}),
          "name leg_1 to leg_6");
  refused(regulus({"margin", kOctahedral, "level_89", "--tube", "x=0:0.1"},
                  {"--quantity", "error", "--limit", "0.05"}),
          "--tube");
}

/// A place of a box around a ball is no place of the ball.
TEST_F(FiniteMargin, RefusesPointsInBalls) {
  std::ofstream(model_) << R"(regulus = 1
name = "ball"
[pose]
l = "m"
[geometry]
c = { value = [0, 0], radius = 0.1, group = "c" }
[closure]
unknowns = { q = "m" }
equations = ["(q - c_1)^2 - c_2 - l"]
start = { l = 4, q = 2 }
[motion.rest]
l = 4
)";
  for (const CommandResult& result :
       {regulus({"bound", model_}, {"rest", "error", "--finite"}),
        margin(model_, {"rest", "--tube", "l=0:1", "--limit", "1/2"}),
        margin(model_, {"rest", "--tolerance", "c=0:0.2", "--limit", "1/2"})}) {
    EXPECT_EQ(result.exit_code, 64) << result.output;
    EXPECT_THAT(result.errors, HasSubstr("lies in a ball"));
  }
}

}  // namespace
}  // namespace regulus::detail::test::finite_margin_test
