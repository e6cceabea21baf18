// SPDX-License-Identifier: GPL-3.0-or-later
// Messages and reports tell words, units, reasons and remedies that a newcomer understands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
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

/// det = x, of a pose with an angle.
std::string model_text(const std::string& unit, const std::string& range) {
  return "regulus = 1\nname = \"angle\"\n[pose]\nx = \"m\"\nphi = \"" + unit +
         "\"\n[geometry]\nh = { value = 1, tolerance = 0, group = \"h\" }\n"
         "[matrix]\nrows = [[\"x\", \"cos(phi)\"], [\"0\", \"h\"]]\n"
         "[load.push]\nwrench = [100, 0]\n[actuators]\nforce = [-9, 9]\n"
         "[motion.a]\nx = [1, 2]\nphi = " +
         range + "\n";
}

class Message : public testing::Test {
 protected:
  void write(const std::string& unit, const std::string& range) const {
    std::ofstream(model_) << model_text(unit, range);
  }
  [[nodiscard]] CommandResult run(const std::string& command, const Words& words) const {
    return regulus({command, model_, "a"}, words);
  }
  /// Returns what check says to a motion with this range.
  [[nodiscard]] std::string errors_of(const std::string& unit, const std::string& range,
                                      const Words& words = {}) const {
    write(unit, range);
    return run("check", words).errors;
  }

  TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "angle.toml";
};

TEST_F(Message, WarnsOfARangeInRadiansThatIsWiderThanATurn) {
  const auto warning = HasSubstr(
      "phi is [-5, 5] rad, wider than a turn; if degrees are meant, write "
      "\"-5deg\" and \"5deg\"");
  EXPECT_THAT(errors_of("rad", "[-5, 5]"), warning);
  EXPECT_THAT(errors_of("rad", "[0, 1]", {"--range", "phi=-5:5"}), warning);
  EXPECT_THAT(errors_of("rad", "[0, 1]", {"--tube", "phi=5"}),
              HasSubstr("phi is [-5, 5] rad, wider"));
  for (const char* range : {"[-3, 3]", "[-6.28, 6.28]", "[\"-5deg\", \"5deg\"]", "[-4.71, 4.71]"})
    EXPECT_THAT(errors_of("rad", range), Not(HasSubstr("turn"))) << range;
  EXPECT_THAT(errors_of("deg", "[-5, 5]"), Not(HasSubstr("turn")));
}

TEST_F(Message, WarnsOfAColumnOfWayPointsThatIsWiderThanATurn) {
  write("rad", "0");
  const std::string way = folder_.path() / "way.csv";
  std::ofstream(way) << "x,phi\n1,-5\n1,-2\n1,1\n1,4\n";
  EXPECT_THAT(run("check", {"--waypoints", way}).errors,
              HasSubstr("way.csv:1: phi is [-5, 4] rad, wider than a turn"));
}

TEST_F(Message, RefusesRangesOfWayPoints) {
  write("rad", "0");
  const std::string way = folder_.path() / "way.csv";
  std::ofstream(way) << "x,phi\n1,0\n1,1\n";
  const CommandResult refused = run("check", {"--waypoints", way, "--range", "x=5:6"});
  EXPECT_EQ(refused.exit_code, 64);
  EXPECT_THAT(refused.errors, AllOf(HasSubstr("--range: the question follows the way-points of"),
                                    HasSubstr("leave --range out")));
}

TEST_F(Message, SaysHowANumberWithItsUnitIsWritten) {
  write("rad", "[0, 1]");
  EXPECT_THAT(run("check", {"--range", "x=1mm:2"}).errors,
              HasSubstr("only deg is written behind one; write 1 if that is its unit"));
  EXPECT_THAT(run("check", {"--range", "phi=0:5degrees"}).errors, HasSubstr("write 5deg"));
  EXPECT_THAT(errors_of("rad", "[0, 30deg]"),
              HasSubstr("expected an expression as text, in quotes: \"30deg\""));
  EXPECT_THAT(errors_of("rad", "[-pi/12, 1]"), HasSubstr("in quotes: \"-pi/12\""));
  EXPECT_THAT(errors_of("rad", "[0, 1"), HasSubstr("expected TOML 1.0"));
  EXPECT_THAT(errors_of("rad", "upper"), HasSubstr("expected text in quotes: \"upper\""));
}

TEST_F(Message, OfACommandLineSaysWhatToDo) {
  const auto errors = [](std::vector<std::string> words) { return regulus(words).errors; };
  EXPECT_EQ(errors({"check"}),
            "regulus: MODEL is required: the path of a model file, or the name of an installed "
            "model, which regulus list shows\n");
  EXPECT_EQ(errors({"report", kPlanar}),
            "regulus: --output is required; regulus report --help says more\n");
  EXPECT_EQ(errors({"check", kPlanar, "--max-boxes", "abc"}).find("Run with"), std::string::npos);
}

TEST_F(Message, SaysWhatIsExceededInTheStepsOfAMargin) {
  write("rad", "0");
  const CommandResult limit = run("margin", {"--grow", "x=1:4", "--quantity", "x", "--limit", "3"});
  EXPECT_THAT(limit.errors,
              AllOf(HasSubstr("EXCEEDED "), HasSubstr("WITHIN "), Not(HasSubstr("SINGULARITY"))));
  const CommandResult threshold = run("margin", {"--alpha", "0.5:3"});
  EXPECT_THAT(threshold.errors,
              AllOf(HasSubstr("SAFE "), HasSubstr("NOT SAFE "), Not(HasSubstr("SINGULARITY "))));
  const json report = json::parse(
      run("margin", {"--grow", "x=1:4", "--quantity", "x", "--limit", "3", "--json", "--quiet"})
          .output);
  for (const json& step : report["steps"])
    EXPECT_THAT(step["verdict"], testing::AnyOf("within", "exceeded", "possible-problem"));
}

TEST_F(Message, HasTheUnitOfBothEndsOfABracket) {
  std::ofstream(model_) << "regulus = 1\nname = \"two\"\n[pose]\nx = \"m\"\n[matrix]\n"
                           "rows = [[\"2 - x\"]]\n[motion.a]\nx = [0, 1]\n";
  EXPECT_THAT(run("margin", {"--grow", "x=0:3"}).output,
              testing::MatchesRegex("SAFE UP TO [0-9.]+ m, NOT AT [0-9.]+ m\n"));
}

TEST_F(Message, SaysWhyAMarginDoesNotBeginBelow0) {
  write("rad", "[-1, 1]");
  EXPECT_THAT(
      run("margin", {"--grow", "phi=-1*deg:3"}).errors,
      HasSubstr("--grow: '-1*deg' is below 0, and the values of a margin begin at 0 or above"));
}

TEST_F(Message, CountsOneBoxAsOne) {
  write("rad", "[0, 1]");
  const std::string bound = run("bound", {"determinant", "--gap", "0.9"}).errors;
  EXPECT_THAT(bound, Not(HasSubstr(" 1 boxes")));
  EXPECT_THAT(bound, Not(HasSubstr("model 0.0 ms")));
}

TEST_F(Message, HasNoSignOfAZero) {
  std::ofstream(model_) << "regulus = 1\nname = \"zero\"\n[pose]\nx = \"m\"\n[matrix]\n"
                           "rows = [[\"-x\"]]\n[motion.a]\nx = [-1, 1]\n";
  const CommandResult result = run("check", {"--json", "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, Not(HasSubstr("-0.0")));
}

TEST_F(Message, HasTheUnitsOfAWrench) {
  write("rad", "[0, 1]");
  const CommandResult result = run("check", {"--load", "push", "--json", "--quiet"});
  const json report = json::parse(result.output);
  ASSERT_FALSE(report["witness"].is_null()) << result.output;
  EXPECT_EQ(report["witness"]["wrench_units"].size(), report["witness"]["wrench"].size());
  EXPECT_TRUE(report["witness"].contains("work_unit"));
}

TEST(MessageOfClosures, SpeaksOfOneUncertainQuantity) {
  const CommandResult result = regulus({"check", model_path("four_bar"), "swing"});
  EXPECT_THAT(result.errors + result.output,
              HasSubstr("every value of the uncertain quantity (1 control error)"));
}

TEST(MessageOfDatasheet, TellsAReasonOnce) {
  const CommandResult result =
      regulus({"datasheet", model_path("planar_3rpr"), "regular", "--time-limit", "1", "--quiet"});
  const std::string start = "not bounded: condition";
  const std::size_t first = result.output.find(start);
  ASSERT_NE(first, std::string::npos) << result.output;
  EXPECT_EQ(result.output.find(start, first + 1), std::string::npos) << result.output;
}

TEST(MessageOfSolve, NamesTheOptionThatGivesAValue) {
  const CommandResult result = regulus({"solve", model_path("four_bar"), "turn"});
  EXPECT_EQ(result.exit_code, 64);
  EXPECT_THAT(result.errors, HasSubstr("give theta=VALUE by the option at"));
}

TEST(MessageOfSolve, HasTheDashesOfAnOption) {
  EXPECT_THAT(regulus({"solve", model_path("rpr_6"), "--method", "jk"}).errors,
              HasSubstr("--method: all solutions are found by one method"));
}

TEST(MessageOfSolve, SaysThatNoCertificateWasWritten) {
  const TemporaryDirectory folder;
  const std::string file = folder.path() / "proof";
  // The search of the nominal platform, which has fewer poses than can be counted, comes to no end.
  const CommandResult result = regulus(
      {"solve",       kRobot1,     "--at",        "x=1",  "--at",          "y=2",  "--at",
       "z=47",        "--at",      "psi=0.1",     "--at", "theta=0.12",    "--at", "phi=0.05",
       "--tolerance", "base=1e-3", "--max-boxes", "1",    "--certificate", file,   "--quiet"});
  EXPECT_THAT(result.output, HasSubstr("INCOMPLETE"));
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_THAT(result.errors, HasSubstr("no certificate was written: this list is without the "
                                       "tolerances and errors of the file"));
}

TEST(MessageOfSolve, HasPosesInTheOrientationOfTheModel) {
  const Words place = {"solve", kRobot1, "--at",    "x=1",  "--at",       "y=2",  "--at",
                       "z=47",  "--at",  "psi=0.1", "--at", "theta=0.12", "--at", "phi=0.05"};
  const CommandResult people = regulus(place);
  EXPECT_THAT(people.errors, AllOf(HasSubstr("psi [rad]"), HasSubstr("theta [rad]"),
                                   HasSubstr("phi [rad]"), Not(HasSubstr(" qw "))));
  const json report = json::parse(regulus(place, {"--json", "--quiet"}).output);
  const json asked = {{"x", 1.0},   {"y", 2.0},      {"z", 47.0},
                      {"psi", 0.1}, {"theta", 0.12}, {"phi", 0.05}};
  const auto is_asked = [&](const json& solution) {
    for (const auto& [name, value] : asked.items()) {
      const json& x = solution["pose"][name];
      if (x[0].get<double>() > value.get<double>() + 1e-9 ||
          x[1].get<double>() < value.get<double>() - 1e-9)
        return false;
    }
    return true;
  };
  EXPECT_TRUE(std::ranges::any_of(report["solutions"], is_asked)) << report["solutions"];
}

}  // namespace
}  // namespace regulus::detail::test
