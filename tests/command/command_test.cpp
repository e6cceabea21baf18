// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the command as its users see it: exit codes, both output streams, the JSON report.
#include "tests/support/command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/command/emitted_text.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

TEST(Command, PutsTheVerdictAloneOnStandardOutput) {
  const CommandResult none = regulus({"check", kPlanar, "regular"});
  EXPECT_EQ(none.output, "NO SINGULARITY\n");
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_THAT(none.errors, HasSubstr("the full 3×3 matrix has full rank"));

  const CommandResult singular = regulus({"check", kPlanar, "crossing"});
  EXPECT_EQ(singular.output, "SINGULARITY\n");
  EXPECT_EQ(singular.exit_code, 1);
}

TEST(Command, SaysNothingElseWhenQuiet) {
  EXPECT_EQ(regulus({"check", kPlanar, "regular", "--quiet"}).errors, "");
}

TEST(Command, ShowsNoProgressInAPipe) {
  EXPECT_THAT(regulus({"check", kPlanar, "regular"}).errors, testing::Not(HasSubstr("\r")));
}

TEST(Command, NamesThePoseAtWhichUncertaintyDefeatsTheTest) {
  const CommandResult result = regulus(
      {"check", kRobot1, "T1", "--method", "reg", "--tolerance", "base,platform=0.05", "--json"});
  const json report = json::parse(result.output);
  ASSERT_EQ(report["reason"], "at one pose the uncertain quantities alone defeat the test");
  const json box = report["blocking_box"]["T"], pose = report["blocking_pose"]["T"];
  EXPECT_EQ(pose[0], pose[1]);
  EXPECT_LE(box[0], pose[0]);
  EXPECT_LE(pose[1], box[1]);
  EXPECT_THAT(result.errors, HasSubstr("the pose is its middle, T = "));
}

TEST(Command, ReportsEveryPromisedKeyAsJson) {
  const json report = json::parse(regulus({"check", kPlanar, "crossing", "--json"}).output);
  for (const char* key :
       {"verdict", "reason", "alpha", "method", "boxes", "max_frontier", "bits", "motion", "model",
        "model_sha256", "witness", "blocking_box", "seconds", "engine", "isa", "cache"})
    EXPECT_TRUE(report.contains(key)) << key;
  for (const char* stage : {"model", "symbolic", "program", "search", "total"})
    EXPECT_TRUE(report["seconds"].contains(stage)) << stage;
  EXPECT_EQ(report["verdict"], "singularity");
  const json& witness = report["witness"];
  ASSERT_EQ(witness["points"].size(), 2u);
  for (const json& point : {witness["points"][0], witness["points"][1], witness["near"]})
    for (const char* key : {"parameters", "pose", "uncertain", "determinant"})
      EXPECT_TRUE(point.contains(key)) << key;
  for (const char* key : {"vanishes_within", "nullity", "singular_values"})
    EXPECT_TRUE(witness.contains(key)) << key;
  EXPECT_EQ(witness["twist"]["columns"].size(), 3u);
  EXPECT_EQ(witness["twist"]["vectors"][0].size(), 3u);
  EXPECT_EQ(witness["twist"]["normalised"], "the largest entry is 1");
  EXPECT_EQ(witness["rows"]["vectors"][0].size(), 3u);
  for (const char* part : {"twist", "rows"}) EXPECT_EQ(witness[part]["approximate"], true);
}

TEST(Command, GivesAWitnessInsideTheVariety) {
  const json report = json::parse(regulus({"check", kPlanar, "crossing", "--json"}).output);
  for (const json& point : report["witness"]["points"]) {
    const json& x = point["parameters"]["x"];
    EXPECT_GE(x[0].get<double>(), -2);
    EXPECT_LE(x[1].get<double>(), 4);
  }
}

TEST(Command, ChangesARangeFromTheCommandLine) {
  const CommandResult narrowed =
      regulus({"check", kPlanar, "crossing", "--range", "phi=-15*deg:5*deg", "--quiet"});
  EXPECT_EQ(narrowed.output, "NO SINGULARITY\n");
}

TEST(Command, ComparesWithAThreshold) {
  const auto verdict = [](const std::string& alpha) {
    return regulus({"check", kPlanar, "regular", "--alpha", alpha, "--quiet"}).output;
  };
  EXPECT_EQ(verdict("1/1000"), "NO SINGULARITY\n");
  EXPECT_EQ(verdict("1000"), "SINGULARITY\n");
}

TEST(Command, AgreesWithItselfOnEveryEngineAndMethod) {
  for (const char* method : {"auto", "reg", "reg+rohn", "kj", "kj+rohn", "jk", "jk+rohn",
                             "kj-numeric", "jk-numeric", "closed-form"}) {
    EXPECT_EQ(regulus({"check", kPlanar, "regular", "--quiet", "--engine", "interpreted",
                       "--method", method})
                  .output,
              "NO SINGULARITY\n")
        << method;
  }
}

TEST(Command, StopsAtABudgetWithAReason) {
  const CommandResult stopped = regulus(
      {"check", kRobot1, "wide_15", "--max-boxes", "3", "--json", "--engine", "interpreted"});
  EXPECT_EQ(stopped.exit_code, 2);
  const json report = json::parse(stopped.output);
  EXPECT_EQ(report["verdict"], "possible-problem");
  EXPECT_THAT(report["reason"].get<std::string>(), HasSubstr("number of boxes"));
  EXPECT_FALSE(report["blocking_box"].is_null());
}

/// Expanding this takes minutes; nothing is certain yet, and an interrupt must not wait for it.
TEST(Command, EndsWithAReportWhenInterruptedLongBeforeASearch) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningCommand running({kCommand, "check", REGULUS_SOURCE_DIR "/models/robot_2.toml",
                            "table5_30", "--tolerance", "base,platform=1", "--method",
                            "closed-form", "--symbolic-budget", "1000000000", "--no-cache"});
    running.wait_for_handler(signal);
    kill(running.pid(), signal);
    const CommandResult result = running.wait();
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "POSSIBLE PROBLEM\n");
  }
}

TEST(Command, EndsWithAReportWhenInterrupted) {
  RunningCommand running({kCommand, "check", kRobot1, "wide_15", "--method", "reg", "--engine",
                          "interpreted", "--json", "--quiet"});
  running.wait_for_handler(SIGINT);
  kill(running.pid(), SIGINT);
  const CommandResult result = running.wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(json::parse(result.output)["reason"].get<std::string>(), HasSubstr("interrupted"));
}

TEST(Command, RefusesWrongUseWith64) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {},
           {"check"},
           {"no-such-command"},
           {"check", kPlanar, "no_such_motion"},
           {"check", kPlanar},
           {"check", kPlanar, "regular", "--method", "guess"},
           {"check", kPlanar, "regular", "--range", "phi"},
           {"check", kPlanar, "regular", "--range", "phi=2:1"},
           {"check", kPlanar, "regular", "--tolerance", "nothing=0.1"},
           {"check", kPlanar, "regular", "--alpha", "-1"},
       })
    EXPECT_EQ(regulus(words).exit_code, 64) << testing::PrintToString(words);
}

TEST(Command, SaysWhichNumberAnOptionTakes) {
  const auto message = [](const std::string& option, const std::string& value) {
    const CommandResult result =
        regulus({"check", kPlanar, "regular", "--certificate", "/dev/null/none", option, value});
    EXPECT_EQ(result.exit_code, 64) << option << ' ' << value;
    EXPECT_LT(result.errors.size(), 160U) << result.errors;
    return result.errors;
  };
  for (const char* value : {"0", "-1", "nan", "inf", "1e999", "x", "1s", ""})
    EXPECT_THAT(message("--time-limit", value),
                HasSubstr("--time-limit: found '" + std::string(value) +
                          "', expected a number of seconds above 0"));
  for (const char* value : {"0", "-1", "1.5", "1e3", "99999999999999999999", "x"}) {
    EXPECT_THAT(message("--max-boxes", value), HasSubstr("expected a whole number from 1 on"));
    EXPECT_THAT(message("--symbolic-budget", value), HasSubstr("whole number from 1 on"));
    EXPECT_THAT(message("--threads", value), HasSubstr("expected a whole number from 1 to 1024"));
    EXPECT_THAT(message("--precision", value), HasSubstr("whole number from 53 to 1048576"));
    EXPECT_THAT(message("--shard-size", value),
                HasSubstr("found '" + std::string(value) + "', expected a size from 4096 to"));
  }
  EXPECT_THAT(message("--checkpoint-every", "-1"), HasSubstr("a number of seconds, 0 or more"));
  const CommandResult verify = run_command({kVerify, "none", "--threads", "0"});
  EXPECT_EQ(verify.exit_code, 64);
  EXPECT_THAT(verify.errors, HasSubstr("--threads: found '0', expected a whole number from 1"));
}

TEST(Command, TakesOptionsBeforeItsArguments) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", "--range", "x=0", "--tolerance", "base=0", kPlanar,
                                 "regular"},
        {"check", "--without", "stall", "--quiet", kPlanar, "regular", "--range=x=0:1"},
        {"locate", "--output", "/dev/null", "--picture", "/dev/null/none.vtu", kPlanar, "regular"}})
    EXPECT_THAT(regulus(words).errors, testing::Not(HasSubstr("MODEL is required"))) << words[1];
  EXPECT_EQ(regulus({"check", "--range", "x=0", "--range", "y=14", kPlanar, "regular"}).exit_code,
            0);
}

TEST(Command, SaysWhichWordIsMistyped) {
  const CommandResult command = regulus({"chek", "robot_1", "--json"});
  EXPECT_EQ(command.exit_code, 64);
  EXPECT_EQ(command.errors, "regulus: there is no command 'chek'; did you mean 'check'?\n");
  EXPECT_THAT(command.output, HasSubstr("did you mean 'check'?"));
  for (const char* option : {"--tolerence", "--tolerence=base=1"})
    EXPECT_THAT(regulus({"check", "robot_1", option, "base=1"}).errors,
                HasSubstr("there is no option '--tolerence'; did you mean '--tolerance'?"));
  EXPECT_THAT(regulus({"check", "robot_1", "--xyz"}).errors, HasSubstr("regulus check --help"));
  EXPECT_THAT(regulus({"check", "robot_1", "--picture", "p.svg"}).errors,
              HasSubstr("regulus check has no option '--picture'; it is one of regulus locate"));
  EXPECT_THAT(regulus({"check"}).errors, HasSubstr("MODEL is required"));
  const CommandResult nothing = regulus({});
  EXPECT_EQ(nothing.exit_code, 64);
  EXPECT_THAT(nothing.errors, HasSubstr("Prove that a motion has no singular pose"));
}

TEST(Command, LeavesOutAnIngredientAndSaysSo) {
  const auto report = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"check", kRobot1, "wide_15", "--json"});
    return json::parse(regulus(options).output);
  };
  const json whole = report({});
  EXPECT_EQ(whole["without"], json::array());
  const json natural = report({"--without", "columns"});
  EXPECT_GT(natural["boxes"], whole["boxes"]);
  const json fixed = report({"--without", "columns", "--without", "moving"});
  EXPECT_EQ(fixed["without"], json({"columns", "moving"}));
  EXPECT_EQ(fixed["verdict"], "no-singularity");
  EXPECT_GT(fixed["boxes"], natural["boxes"]);
  EXPECT_THAT(regulus({"check", kPlanar, "regular", "--without", "rewriting"}).errors,
              HasSubstr("auto without rewriting"));
}

/// The rewrites that change nothing in most models; each has a motion where it does.
TEST(Command, ShowsWhatASeldomRewriteDoes) {
  const auto boxes = [](const std::vector<std::string>& motion, std::vector<std::string> options) {
    options.insert(options.begin(), motion.begin(), motion.end());
    options.insert(options.begin(), {"check"});
    options.insert(options.end(), {"--json", "--engine", "interpreted"});
    const json report = json::parse(regulus(options).output);
    EXPECT_EQ(report.at("verdict"), "no-singularity");
    return report.at("boxes").get<int>();
  };
  const std::vector<std::string> disk{kPlanar, "disk"},
      hexapod{REGULUS_SOURCE_DIR "/models/hexapod_6rus.toml", "work"};
  EXPECT_LT(2 * boxes(disk, {}), boxes(disk, {"--without", "squares"}));
  EXPECT_LT(boxes(hexapod, {}), boxes(hexapod, {"--without", "factoring"}));
}

TEST(Command, RefusesAnUnknownIngredientWithTheNamesOfAll) {
  const CommandResult refused = regulus({"check", kPlanar, "regular", "--without", "magic"});
  EXPECT_EQ(refused.exit_code, 64);
  EXPECT_THAT(refused.errors, AllOf(HasSubstr("--without: there is no 'magic'"),
                                    HasSubstr("moving"), HasSubstr("batch")));
}

TEST(Command, RefusesAClosedFormBeyondItsBudgetWithTheWayOut) {
  const CommandResult refused = regulus({"check", kRobot1, "wide_15", "--method", "closed-form",
                                         "--tolerance", "base,platform=0.01"});
  EXPECT_EQ(refused.exit_code, 64);
  EXPECT_EQ(refused.output, "");
  EXPECT_THAT(refused.errors,
              AllOf(HasSubstr("the determinant takes at least "), HasSubstr("the budget is 500000"),
                    HasSubstr("another method"), HasSubstr("--symbolic-budget")));
  EXPECT_THAT(
      regulus({"check", kPlanar, "regular", "--method", "closed-form", "--symbolic-budget", "20"})
          .errors,
      HasSubstr("the budget is 20:"));
}

TEST(Command, RefusesAClosedFormOfAMatrixThatIsNotSquare) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "redundant.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"redundant\"\nsource = \"a test\"\n"
                         "[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x\"], [\"x + 1\"]]\n"
                         "[motion.all]\nx = [0, 1]\n";
  const CommandResult refused = regulus({"check", path, "--method", "closed-form"});
  EXPECT_EQ(refused.exit_code, 64);
  EXPECT_THAT(refused.errors, HasSubstr("2×1; only a square one has a determinant"));
}

TEST(Command, RefusesABadModelWith65AndAMissingOneWith74) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "bad.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"bad\"\nwheels = 4\n";
  const CommandResult bad = regulus({"check", path});
  EXPECT_EQ(bad.exit_code, 65);
  EXPECT_THAT(bad.errors, AllOf(HasSubstr("bad.toml:3: unknown key"), HasSubstr("wheels"),
                                HasSubstr("the keys here are: regulus, name")));
  EXPECT_EQ(regulus({"check", "/no/such/model.toml"}).exit_code, 74);
}

TEST(Command, ChecksAVarietyOfOnePose) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "fixed.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"fixed\"\nsource = \"a test\"\n"
                         "[pose]\nx = \"m\"\ny = \"m\"\n"
                         "[matrix]\nrows = [[\"x - 1\", \"y\"], [\"x + 1\", \"y\"]]\n"
                         "[motion.regular]\nx = \"sqrt(2)\"\ny = \"pi\"\n"
                         "[motion.singular]\nx = 0.5\ny = 0\n";
  EXPECT_EQ(regulus({"check", path, "regular"}).output, "NO SINGULARITY\n");
  const CommandResult singular = regulus({"check", path, "singular"});
  EXPECT_EQ(singular.output, "SINGULARITY\n");
  EXPECT_THAT(
      singular.errors,
      AllOf(HasSubstr("witness    the only pose\n"),
            HasSubstr("determinant = 0 there; rows of these lengths could have one of 0.75")));
}

TEST(Command, HasHelpForEveryCommand) {
  EXPECT_THAT(regulus({"--help"}).output, HasSubstr("POSSIBLE PROBLEM"));
  EXPECT_THAT(regulus({"--help"}).output, HasSubstr("\n  regulus check robot_1 wide_15\n"));
  EXPECT_THAT(regulus({"check", "--help"}).output, HasSubstr("--tolerance"));
  EXPECT_THAT(regulus({"explain", "--help"}).output, HasSubstr("MODEL"));
  EXPECT_THAT(regulus({"--version"}).output, testing::StartsWith("regulus "));
}

TEST(Command, EmitsTheSameBytesInEveryProcess) {
  expect_same_text("robot_1", "T2_errors", "auto", 4);
  expect_same_text("planar_3rpr", "circle", "auto", 8);
}

TEST(Command, ExplainsThePapersTwoForms) {
  const CommandResult explained = regulus({"explain", kRobot1});
  EXPECT_EQ(explained.exit_code, 0);
  EXPECT_THAT(explained.output, HasSubstr("form 1, as written: k_1_1*(x + "));
  EXPECT_THAT(explained.output, HasSubstr("x*(k_1_1 + k_1_2 + k_1_3 + k_1_4 + k_1_5 + k_1_6)"));
}

TEST(Command, WritesACertificateThatBothVerifiersAccept) {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "proof.txt").string();
  for (const char* motion : {"regular", "crossing"}) {
    regulus({"check", kPlanar, motion, "--certificate", file});
    const CommandResult verified = regulus({"verify", file, "--model", kPlanar});
    EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
    EXPECT_EQ(verified.exit_code, 0);
    EXPECT_EQ(run_command({kVerify, file}).output, "VERIFIED\n");
    const CommandResult other = regulus({"verify", file, "--model", kRobot1});
    EXPECT_EQ(other.output, "REJECTED\n");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.errors, HasSubstr("is not about"));
  }
}

TEST(Command, WritesTheCertificateOfALocatedSingularity) {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "proof.txt").string();
  regulus({"locate", kPlanar, "crossing", "--certificate", file, "--quiet"});
  EXPECT_EQ(regulus({"verify", file}).output, "VERIFIED\n");
}

TEST(Command, SaysWhyACertificateCannotBeWritten) {
  const CommandResult refused =
      regulus({"check", kPlanar, "regular", "--certificate", "/nowhere/at/all"});
  EXPECT_EQ(refused.exit_code, 74);
  EXPECT_EQ(refused.output, "");
  EXPECT_THAT(refused.errors,
              HasSubstr("--certificate: /nowhere/at/all cannot be created: there is "
                        "no folder /nowhere/at; make it"));
  EXPECT_EQ(regulus({"verify", "/nowhere/at/all"}).exit_code, 74);
}

TEST(Command, WritesNoCertificateWhereNothingIsClaimed) {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "proof.txt").string();
  const CommandResult none =
      regulus({"check", kRobot1, "wide_15", "--max-boxes", "1", "--certificate", file});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.errors, HasSubstr("proof      none"));
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

}  // namespace
}  // namespace regulus::detail::test
