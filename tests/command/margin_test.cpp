// SPDX-License-Identifier: GPL-3.0-or-later
// Tests brackets as users see them, on models whose critical values are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// det = a − x²/2, with a = 1 ± its tolerance and |x| ≤ 1. It is singular from tolerance 1/2 on; at
/// tolerance 0 from |x| = √2 on, and |det| ≥ 1/2.
constexpr const char* kBowl = R"(regulus = 1
name = "bowl"
[pose]
x = "1"
[geometry]
a = { value = 1, tolerance = 0, group = "a" }
b = { value = 1, tolerance = 0, group = "b" }
[matrix]
rows = [["a", "x/2"], ["x", "b"]]
[motion.small]
x = [-1, 1]
[motion.path]
parameters = { T = [0, 1] }
x = "T"
[motion.half]
x = [-1, 1]
constraints = ["x"]
)";

class Margin : public testing::Test {
 protected:
  Margin() { std::ofstream(model_) << kBowl; }

  [[nodiscard]] CommandResult margin(std::vector<std::string> words) const {
    words.insert(words.end(), {"--engine", "interpreted"});
    return regulus({"margin", model_}, words);
  }
  [[nodiscard]] json report(std::vector<std::string> words, int exit_code = 0) const {
    words.insert(words.end(), {"--json", "--quiet"});
    const CommandResult result = margin(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.errors;
    EXPECT_EQ(result.errors, "");
    return json::parse(result.output);
  }
  /// Expects certified < critical ≤ refuted, within the gap.
  static void expect_brackets(const json& report, double critical, double gap) {
    EXPECT_LT(report["certified"], critical);
    EXPECT_GE(report["refuted"], critical);
    EXPECT_LE(report["gap"], gap);
    EXPECT_TRUE(report["closed"]);
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "bowl.toml";
};

TEST_F(Margin, BracketsAToleranceWhoseCriticalValueIsOneHalf) {
  expect_brackets(report({"small", "--tolerance", "a=0:0.9"}), 0.5, 0.01);
  expect_brackets(report({"small", "--tolerance", "a=0:0.9", "--gap", "1e-3"}), 0.5, 1e-3);
}

TEST_F(Margin, FindsTheUpperEndItself) {
  expect_brackets(report({"small", "--tolerance", "a=0:"}), 0.5, 0.01);
  expect_brackets(report({"small", "--scale", "1:"}), std::sqrt(2), 0.01);
  expect_brackets(report({"small", "--alpha", "0:"}), 0.5, 0.01);
}

TEST_F(Margin, BracketsTheScaleOfABoxVariety) {
  expect_brackets(report({"small", "--scale", "0:2"}), std::sqrt(2), 0.01);
}

TEST_F(Margin, BracketsAThreshold) {
  expect_brackets(report({"small", "--alpha", "0:10"}), 0.5, 0.01);
}

/// Both are singular at 90 degrees.
TEST_F(Margin, GrowsInDegreesAsInRadians) {
  const auto crank = [&](const std::string& unit, const std::string& ends,
                         const std::string& error) {
    std::ofstream(model_) << "regulus = 1\nname = \"crank\"\n[pose]\nth = \"" << unit
                          << "\"\n[matrix]\nrows = [[\"cos(th)\"]]\n[motion.m]\nth = " << ends
                          << "\nerror = { th = " << error << " }\n";
  };
  const double right = std::acos(0.0), degree = right / 90;
  crank("deg", "[-10, 20]", "1");
  for (const char* high : {"120", "120*deg", "120°"})
    expect_brackets(report({"m", "--grow", std::string("th=0:") + high}), 89, 0.01);
  expect_brackets(report({"m", "--tube", "th=0:100"}), 70, 0.01);
  crank("rad", "[\"-10*deg\", \"20*deg\"]", "\"1*deg\"");
  for (const char* high : {"2", "120*deg", "120deg"})
    expect_brackets(report({"m", "--grow", std::string("th=0:") + high}), right - degree, 0.01);
  expect_brackets(report({"m", "--tube", "th=0:1.7"}), 70 * degree, 0.01);
}

TEST_F(Margin, KeepsTheOtherOptionsAsTheyAreGiven) {
  // (1 − e)(1 − 0.1) = 1/2
  expect_brackets(report({"small", "--tolerance", "b=0.1", "--tolerance", "a=0:0.9"}), 4.0 / 9,
                  0.01);
  // 1 − e − 1/2 = 1/4
  expect_brackets(report({"small", "--tolerance", "a=0:0.9", "--alpha", "1/4"}), 0.25, 0.01);
  expect_brackets(report({"small", "--range", "x=0:0.5", "--tolerance", "a=0:2"}), 0.875, 0.01);
}

TEST_F(Margin, LooksBetweenConstraintsToo) {
  expect_brackets(report({"half", "--tolerance", "a=0:0.9"}), 0.5, 0.01);
}

TEST_F(Margin, ReportsEveryKeyThatProgramsReadAndAConcreteWitness) {
  const json found = report({"small", "--tolerance", "a=0:9/10"});
  for (const char* key :
       {"certified", "refuted", "gap", "witness", "boxes", "model", "model_sha256", "motion",
        "method", "seconds", "steps", "reason", "engine", "isa", "cache", "bits"})
    EXPECT_TRUE(found.contains(key)) << key;
  EXPECT_EQ(found["margin"]["kind"], "tolerance");
  EXPECT_EQ(found["margin"]["groups"], "a");
  EXPECT_EQ(found["margin"]["high"], "9/10");
  const json points = found["witness"]["points"];
  ASSERT_EQ(points.size(), 2U);
  const double refuted = found["refuted"];
  for (const json& point : points) {
    EXPECT_GE(point["uncertain"]["a"][0], 1 - refuted - 1e-12);
    EXPECT_LE(point["uncertain"]["a"][1], 1 + refuted + 1e-12);
  }
  EXPECT_GT(points[0]["determinant"][0], 0);
  EXPECT_LT(points[1]["determinant"][1], 0);
  const json near = found["witness"]["near"];
  const double a = near["uncertain"]["a"][0], x = near["parameters"]["x"][0];
  EXPECT_NEAR(a, x * x / 2, 1e-14);
  EXPECT_LE(near["determinant"][1].get<double>() - near["determinant"][0].get<double>(), 1e-14);
  // (a, x/2)·v = 0 and (x, 1)·v = 0
  const json v = found["witness"]["twist"]["vectors"][0];
  EXPECT_NEAR(v[1].get<double>() / v[0].get<double>(), -x, 1e-12);
  EXPECT_EQ(found["witness"]["rows"]["taking_part"], json({1, 2}));
  std::uint64_t boxes = 0;
  for (const json& step : found["steps"]) {
    boxes += step["boxes"].get<std::uint64_t>();
    EXPECT_EQ(step["value"] < 0.5, step["verdict"] == "no-singularity");
  }
  EXPECT_EQ(found["boxes"], boxes);
}

TEST_F(Margin, SaysTheBracketOnTheLastLineAndEachStepOnStandardError) {
  const CommandResult result = margin({"small", "--tolerance", "a=0:0.9"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output,
              testing::MatchesRegex("SAFE UP TO 0\\.49[0-9]*, NOT AT 0\\.5[0-9]*\n"));
  EXPECT_THAT(result.errors, HasSubstr("NO SINGULARITY"));
  EXPECT_THAT(result.errors, HasSubstr("a witness"));
}

TEST_F(Margin, ChecksWhatItClaims) {
  const json found = report({"small", "--tolerance", "a=1/3:0.9"});
  const auto check = [&](const std::string& value) {
    return regulus(
               {"check", model_, "small", "--tolerance", "a=" + value, "--engine", "interpreted"})
        .exit_code;
  };
  EXPECT_EQ(check(found["certified_exact"]), 0);
  EXPECT_EQ(check(found["refuted_exact"]), 1);
}

TEST_F(Margin, SaysThatAllIsSafeWhenTheUpperEndIsCertified) {
  const CommandResult result = margin({"small", "--tolerance", "a=0:1/3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, "SAFE UP TO 1/3\n");
  const json found = report({"small", "--tolerance", "a=0:1/3"});
  EXPECT_LE(found["certified"], 1.0 / 3);
  EXPECT_EQ(found["reason"], "all of the range is safe");
}

TEST_F(Margin, ExitsWith1WhenTheLowerEndIsNotSafe) {
  const CommandResult result = margin({"small", "--tolerance", "a=0.6:0.9"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.output, "NOT SAFE AT 0.6\n");
  EXPECT_EQ(report({"small", "--tolerance", "a=0.6:0.9"}, 1)["reason"],
            "the lower end is not safe");
}

TEST_F(Margin, ExitsWith2WhenALimitEndsItEarly) {
  const json found = report({"small", "--tolerance", "a=0:0.9", "--time-limit", "1e-9"}, 2);
  EXPECT_FALSE(found["closed"]);
  EXPECT_TRUE(found["certified"].is_null());
}

/// The time is not the reason.
TEST_F(Margin, SaysWhyNothingIsKnownWhereTheMatrixIsUndefined) {
  std::ofstream(model_) << "regulus = 1\nname = \"root\"\n[pose]\nx = \"1\"\n[matrix]\n"
                           "rows = [[\"sqrt(x - 2)\"]]\n[motion.m]\nx = [-1, 1]\n";
  const CommandResult result = margin({"m", "--scale", "1:2"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("decided nothing: an expression is undefined in or near a"));
}

TEST_F(Margin, RefusesWrongUseWith64AndSaysWhy) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"small"}, "margin: 0 options have a range"},
      {{"small", "--tolerance", "a=0.1"}, "such as 0:0.5 (one number is a value, no range)"},
      {{"small", "--tolerance", "a=0:1", "--alpha", "0:1"}, "margin: 2 options have a range"},
      {{"small", "--tolerance", "a=1:0"}, "expected LO below HI"},
      {{"small", "--tolerance", "a=-1:0"}, "a number ≥ 0"},
      {{"small", "--tolerance", "a=0:x"}, "--tolerance"},
      {{"small", "--tolerance", "nothing=0:1"}, "nothing"},
      {{"small", "--scale", "2"}, "expected LO:HI"},
      {{"path", "--scale", "0:2"}, "the motion 'path' is not a box"},
      {{"small", "--alpha", "0:1", "--gap", "0"}, "--gap"},
      {{"nowhere", "--alpha", "0:1"}, "nowhere"},
  };
  for (const auto& [words, why] : cases) {
    const CommandResult result = margin(words);
    EXPECT_EQ(result.exit_code, 64) << why;
    EXPECT_THAT(result.errors, HasSubstr(why));
    EXPECT_EQ(result.output, "");
  }
}

/// As if the run had been killed after some of its searches.
TEST_F(Margin, ContinuesFromItsCheckpoint) {
  const std::string saved = directory_.path() / "saved";
  const auto ask = [&](const std::string& proof) {
    return margin({"small", "--tolerance", "a=0:0.9", "--threads", "1", "--json", "--gap", "1e-3",
                   "--checkpoint", saved, "--certificate", directory_.path() / proof});
  };
  const auto bytes_of = [this](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(directory_.path() / name, std::ios::binary).rdbuf();
    return text.str();
  };
  const CommandResult whole = ask("whole");
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const json first = json::parse(whole.output), searches = json::parse(bytes_of("saved"));
  ASSERT_EQ(searches["known"]["brackets"].size(), 1U);
  ASSERT_GT(searches["known"]["brackets"].front().size(), 2U);
  for (std::size_t kept = 0; kept <= searches["known"]["brackets"].front().size(); ++kept) {
    json part = searches;
    json& some = part["known"]["brackets"].front();
    while (some.size() > kept) some.erase(std::prev(some.end()).key());
    std::ofstream(saved) << part.dump();
    const json report = json::parse(ask("part").output);
    for (const char* key : {"bracket", "certified_claim", "boxes", "closed", "witness"})
      EXPECT_EQ(report[key], first[key]) << key << kept;
    for (const char* end : {".safe", ".singular"})
      EXPECT_TRUE(bytes_of(std::string("part") + end) == bytes_of(std::string("whole") + end))
          << end << kept;
  }
  const CommandResult other = margin({"small", "--alpha", "0:1", "--checkpoint", saved});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("another question"));
}

TEST_F(Margin, GivesTheBracketSoFarWhenInterrupted) {
  RunningCommand running({kCommand, "margin", kRobot1, "table4_5", "--tolerance",
                          "base,platform=0.19:0.4", "--engine", "interpreted", "--json",
                          "--quiet"});
  std::this_thread::sleep_for(std::chrono::seconds(3));
  kill(running.pid(), SIGINT);
  const CommandResult result = running.wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(json::parse(result.output)["reason"], HasSubstr("interrupted"));
}

}  // namespace
}  // namespace regulus::detail::test
