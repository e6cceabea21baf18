// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus solve`: lengths and tools by name, tables of places, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRegulus = REGULUS_BINARY_DIR "/bin/regulus";
constexpr const char* kTable =
    "t [ms], rho_1, rho_2, rho_3, id\n"
    "0, 14.98, 15.38, 12, 7\n"
    "# a comment\n"
    "250, 14.9, 15.4, 12.1, 8\n"
    "500, 100, 1, 1, 9\n";

class AllSolutionsByCommand : public testing::Test {
 protected:
  static CommandResult solve(std::vector<std::string> words) {
    words.insert(words.begin(), {kRegulus, "solve"});
    return run_command(words);
  }
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    const std::string path = folder_.path() / name;
    std::ofstream(path) << text;
    return path;
  }
  static json report(std::vector<std::string> words) {
    words.insert(words.end(), {"--json", "--quiet"});
    return json::parse(solve(words).output);
  }

  TemporaryDirectory folder_;
};

TEST_F(AllSolutionsByCommand, TakeErrorsOfThePlaceByName) {
  const std::vector<std::string> tool = {
      "puma_560_serial", "--at", "x=0.4",     "--at", "y=0.1", "--at", "z=0.5", "--at",
      "roll=0",          "--at", "pitch=0.2", "--at", "yaw=1"};
  const auto with = [&tool](const std::string& error, std::vector<std::string> more = {}) {
    std::vector<std::string> words = tool;
    words.insert(words.end(), {"--tube", error});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const CommandResult x = solve(with("x=0.001"));
  EXPECT_THAT(x.output, HasSubstr("COMPLETE: 8 postures"));
  EXPECT_THAT(x.errors, HasSubstr("x_error in [-0.001, 0.001] m"));
  EXPECT_EQ(report(with("x=0.001"))["question"]["place"]["x"]["exact"], "2/5");
  EXPECT_THAT(solve(with("q1=0.001")).errors, HasSubstr("x, y, z, roll, pitch"));
  EXPECT_THAT(solve(with("0.001")).errors, HasSubstr("name the parameters of each"));
  EXPECT_THAT(solve({"rpr_6", "--tube", "rho_1=0.001"}).output, HasSubstr("COMPLETE: 6 poses"));
  EXPECT_THAT(solve({"rpr_6", "--tube", "rho_1=0.001"}).errors, HasSubstr("rho_1_error in"));
}

TEST_F(AllSolutionsByCommand, TakeTheLengthsOfTheLegsByName) {
  const json given =
      report({"rpr_6", "--at", "rho_1=14.98", "--at", "rho_2=15.38", "--at", "rho_3=12"});
  const json of_motion = report({"rpr_6"});
  EXPECT_EQ(given["solutions"], of_motion["solutions"]);
  const json& place = given["question"]["place"];
  EXPECT_EQ(place["rho_2"]["exact"], "769/50");
  EXPECT_EQ(place["rho_2"]["unit"], "1");
  EXPECT_EQ(place, of_motion["question"]["place"]);
  // One of them changes that of the motion.
  EXPECT_EQ(report({"rpr_6", "--at", "rho_3=12.1"})["question"]["place"]["rho_3"]["exact"],
            "121/10");
}

/// The errors of a motion by lengths are of the legs, and not of a pose.
TEST_F(AllSolutionsByCommand, NameTheErrorsOfTheLegs) {
  const auto errors_of = [this](const std::string& legs, const std::string& lengths) {
    return report(
        {file("robot.toml", "regulus = 1\nname = \"robot\"\n" + legs +
                                "[motion.l]\nlegs = " + lengths + "\nerror = { legs = 0.01 }\n"),
         "l"})["question"]["uncertain"];
  };
  const json plane = errors_of(
      "[legs]\nunit = \"mm\"\nleg = [\n{ type = \"RPR\", base = [0, 0], platform = [0, 0] },\n"
      "{ type = \"RPR\", base = [300, 20], platform = [120, 0] },\n"
      "{ type = \"RPR\", base = [50, 280], platform = [30, 90] },\n]\n",
      "[210, 230, 190]");
  ASSERT_EQ(plane.size(), 3U);
  EXPECT_EQ(plane[1]["name"], "rho_2_error");
  EXPECT_EQ(plane[1]["tolerance_exact"], "1/100");
  EXPECT_EQ(plane[1]["unit"], "mm");
  const json space = errors_of(
      "[gough]\norientation = \"euler-zxz\"\nbase = "
      "[[-9,9,0],[9,9,0],[12,-3,0],[3,-13,0],[-3,-13,0],[-12,-3,0]]\n"
      "platform = [[-3,7,0],[3,7,0],[7,-1,0],[4,-6,0],[-4,-6,0],[-7,-1,0]]\n",
      "[47.5, 48.25, 48.125, 47.75, 47.25, 47.875]");
  EXPECT_EQ(space.size(), 6U);
}

TEST_F(AllSolutionsByCommand, TakeTheLengthsOfAHexapodByName) {
  const json poses =
      report({"dietmaier", "--at", "rho_1=1", "--at", "rho_2=0.645275", "--at", "rho_3=1.086284",
              "--at", "rho_4=1.503439", "--at", "rho_5=1.281933", "--at", "rho_6=0.771071"});
  EXPECT_EQ(poses["verdict"], "complete");
  EXPECT_EQ(poses["solutions"].size(), 40U);
}

TEST_F(AllSolutionsByCommand, TakeTheToolOfAnArm) {
  const json postures = report({"puma_560_serial", "--at", "x=0.4", "--at", "y=0.1", "--at",
                                "z=0.5", "--at", "roll=0", "--at", "pitch=0.2", "--at", "yaw=1"});
  EXPECT_EQ(postures["solutions"].size(), 8U);
  const json& place = postures["question"]["place"];
  EXPECT_EQ(place["x"]["unit"], "m");
  EXPECT_EQ(place["yaw"]["unit"], "rad");
  EXPECT_THAT(solve({"puma_560_serial", "--at", "x=0.4"}).errors,
              HasSubstr("no motion is given, and y, z, roll, pitch, yaw have no value"));
}

/// cos p = 1 - 1e-9 has two solutions that are almost one.
TEST_F(AllSolutionsByCommand, AnnounceAProofThatTheVerifierDoesNotFinish) {
  const std::string proof = folder_.path() / "proof.txt";
  const auto note_of = [&](const std::string& cosine) {
    const std::string model =
        file("turn.toml",
             "regulus = 1\nname = \"turn\"\n[pose]\nt = \"1\"\n[closure]\n"
             "unknowns = { p = \"rad\" }\nequations = [\"cos(p) - " +
                 cosine +
                 "\"]\nstart = { t = 0, p = 0 }\nrange = { p = [-100, 100] }\n"
                 "[motion.m]\nt = 0\n");
    const json found = report({model, "--certificate", proof});
    EXPECT_EQ(found["certificate"], proof);
    return found.value("certificate_note", "");
  };
  EXPECT_THAT(note_of("1 + 0.000000001"), HasSubstr("the verifier may not finish: line 11"));
  EXPECT_EQ(run_command({kRegulus, "verify", proof}).exit_code, 2);
  EXPECT_EQ(note_of("0.5"), "");
  EXPECT_EQ(run_command({kRegulus, "verify", proof}).exit_code, 0);
}

TEST_F(AllSolutionsByCommand, HelpShowsNoOptionThatIsAlwaysRefused) {
  for (const char* command : {"solve", "bound", "datasheet"})
    EXPECT_THAT(run_command({kRegulus, command, "--help"}).output, Not(HasSubstr("--alpha")));
  const std::string help = run_command({kRegulus, "solve", "--help"}).output;
  for (const char* option : {"--method", "--determinant", "--bisect", "--without", "--precision"})
    EXPECT_THAT(help, Not(HasSubstr(option)));
  EXPECT_THAT(solve({"rpr_6", "--method", "jk"}).errors, HasSubstr("found by one method"));
}

TEST_F(AllSolutionsByCommand, SayWhatWasHeld) {
  std::vector<std::string> words = {"seven_joints", "--hold", "q1"};
  for (int joint = 1; joint <= 7; ++joint) {
    words.emplace_back("--at");
    words.push_back("q" + std::to_string(joint) + "=0." + std::to_string(joint));
  }
  const json arm = report(words);
  EXPECT_EQ(arm["question"]["held"], json({"q1"}));
}

TEST_F(AllSolutionsByCommand, TakeAJointThatKeepsItsValueBesideTheTool) {
  const std::vector<std::string> tool = {"seven_joints", "--at",  "x=0.4", "--at",   "y=0.1",
                                         "--at",         "z=0.6", "--at",  "roll=2", "--at",
                                         "pitch=0.2",    "--at",  "yaw=1"};
  const auto with = [&tool](std::vector<std::string> more) {
    more.insert(more.begin(), tool.begin(), tool.end());
    return more;
  };
  const json found = report(with({"--at", "q3=0.25"}));
  EXPECT_EQ(found["verdict"], "complete");
  EXPECT_EQ(found["question"]["place"]["q3"]["exact"], "1/4");
  EXPECT_EQ(found["solutions"], report(with({"--at", "q3=1/4", "--hold", "q3"}))["solutions"]);
  EXPECT_THAT(solve(with({})).errors, HasSubstr("such as at q7=VALUE"));
  EXPECT_THAT(solve(with({"--hold", "q3"})).errors, HasSubstr("at q3=VALUE"));
  EXPECT_THAT(solve(with({"--at", "q8=1"})).errors, HasSubstr("no 'q8'"));
  EXPECT_THAT(solve(with({"--at", "q3=1", "--at", "q4=1"})).errors, HasSubstr("5 joints are free"));
}

TEST_F(AllSolutionsByCommand, OfATableHaveALineForEachPlace) {
  const CommandResult found = solve({"rpr_6", "--waypoints", file("lengths.csv", kTable)});
  EXPECT_EQ(found.exit_code, 1);
  EXPECT_EQ(found.output, "NONE at 1, COMPLETE at 2 of 3 places: 12 poses\n");
  EXPECT_THAT(found.errors, HasSubstr("answers    line 2, t = 0 ms: COMPLETE: 6 poses\n"
                                      "           line 4, t = 250 ms: COMPLETE: 6 poses\n"
                                      "           line 5, t = 500 ms: NONE\n"));
  EXPECT_THAT(found.errors, HasSubstr("columns not used: id"));
}

TEST_F(AllSolutionsByCommand, OfATableAreJsonLinesAndAReport) {
  const std::string table = file("lengths.csv", kTable), lines = folder_.path() / "lines.jsonl";
  const json whole = report({"rpr_6", "--waypoints", table, "--output", lines});
  EXPECT_EQ(whole["verdict"], "none");
  EXPECT_EQ(whole["places"].size(), 3U);
  EXPECT_EQ(whole["places_file"]["time_unit"], "ms");
  std::ifstream stream(lines);
  std::size_t count = 0;
  for (std::string line; std::getline(stream, line); ++count)
    EXPECT_EQ(json::parse(line), whole["places"][count]);
  EXPECT_EQ(count, 3U);
  EXPECT_EQ(whole["places"][0]["solutions"], report({"rpr_6"})["solutions"]);
  const CommandResult printed = solve({"rpr_6", "--waypoints", table, "--output", "-", "--quiet"});
  std::stringstream kept;
  kept << std::ifstream(lines).rdbuf();
  EXPECT_EQ(printed.output, kept.str());
}

TEST_F(AllSolutionsByCommand, OfATableOfAngles) {
  const std::string table = file("theta.csv", "theta [deg]\n67.38\n90\n");
  const CommandResult found = solve({"double_butterfly", "--waypoints", table, "--quiet"});
  EXPECT_EQ(found.exit_code, 0);
  EXPECT_EQ(found.output, "COMPLETE at 2 of 2 places: 12 configurations\n");
  EXPECT_EQ(report({"double_butterfly", "--waypoints", table})["places"][0]["solutions"].size(),
            report({"double_butterfly", "--at", "theta=67.38*deg"})["solutions"].size());
}

TEST_F(AllSolutionsByCommand, TakeAPartOfThePlaceFromTheTable) {
  const std::string table = file("two.csv", "rho_1,rho_2\n14.98,15.38\n");
  const CommandResult found = solve({"rpr_6", "--at", "rho_3=12", "--waypoints", table, "--quiet"});
  EXPECT_EQ(found.output, "COMPLETE at 1 of 1 place: 6 poses\n");
}

TEST_F(AllSolutionsByCommand, RefuseWhatHasNoMeaning) {
  const std::string table = file("lengths.csv", kTable);
  const auto refuse = [](std::vector<std::string> words, int code, const char* why) {
    words.push_back("--quiet");
    const CommandResult refused = solve(words);
    EXPECT_EQ(refused.exit_code, code) << why;
    EXPECT_THAT(refused.errors, HasSubstr(why));
  };
  refuse({"rpr_6", "--at", "rho_1=1", "--at", "rho_1=2"}, 64, "'rho_1' is given twice");
  refuse({"rpr_6", "--at", "rho_1=-1"}, 64, "found the negative number");
  refuse({"rpr_6", "--at", "rho_4=1"}, 64, "did you mean 'rho_1'?");
  refuse({"rpr_6", "--at", "rho_1=1:2"}, 64, "found ':'");
  refuse({"robot_1", "wide_15", "--at", "rho_1=1"}, 64,
         "gives the pose, and 'rho_1' takes its place; give all of rho_1");
  refuse({"rpr_6", "--at", "rho_1=1,rho_2=2"}, 64,
         "gives more than one value; repeat the option, one NAME=VALUE each");
  refuse({"robot_1", "--at", "x=1"}, 64, "y, z, psi, theta, phi have no value");
  refuse({"four_bar", "--at", "teta=1"}, 64, "did you mean 'theta'?");
  refuse({"rpr_6", "--waypoints", table, "--at", "rho_1=3"}, 65, "'rho_1' is given for all places");
  refuse({"rpr_6", "--output", "x.jsonl"}, 64, "--output: lines are of many places");
  refuse({"rpr_6", "--waypoints", "/nowhere.csv"}, 74, "no such file");
  refuse({"rpr_6", "--waypoints", file("way.nc", "G1 X1\n")}, 65, "moves in G-code");
  refuse({"rpr_6", "--waypoints", file("empty.csv", "")}, 65, "the file is empty");
  refuse({"rpr_6", "--waypoints", file("head.csv", "rho_1\n")}, 65, "there are no places");
  refuse({"rpr_6", "--waypoints", file("other.csv", "a,b\n1,2\n")}, 65, "name columns x, y, phi");
  refuse({"rpr_6", "--waypoints", file("typo.csv", "rho_1,rho_2,roh_3\n1,2,3\n")}, 65,
         "did you mean 'rho_3'?");
  refuse({"rpr_6", "--waypoints", file("negative.csv", "rho_1\n1\n-2\n")}, 65,
         "negative.csv:3: found the negative number");
  refuse({"rpr_6", "--waypoints", file("unit.csv", "rho_1 [kg]\n1\n")}, 65, "is in 'kg'");
  refuse({"rpr_6", "--waypoints", table, "--output", "-", "--json"}, 64, "both write");
}

}  // namespace
}  // namespace regulus::detail::test
