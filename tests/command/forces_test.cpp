// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `regulus check --load` and `regulus locate --load` as users see them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A bead on a rail between two pulleys. It is held where |x| is small enough.
constexpr const char* kBead = R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
[load.push]
force = [[-2, 2]]
[load.nothing]
force = [0]
[actuators]
force = [1, 9]
force_unit = "kN"
[motion.m]
x = [-0.5, 0.5]
)toml";

class ForcesCommandTest : public testing::Test {
 protected:
  ForcesCommandTest() { std::ofstream(model_) << kBead; }

  TemporaryDirectory folder_;
  std::string model_ = folder_.path() / "bead.toml";
};

TEST_F(ForcesCommandTest, SaysFeasibleWithTheClaim) {
  const CommandResult r = regulus({"check", model_, "--load", "push"});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_EQ(r.output, "FEASIBLE\n");
  EXPECT_THAT(r.errors, HasSubstr("proved     at every pose of the motion, forces within [1, 9] kN "
                                  "hold every wrench of push\n"));
}

/// At x the most is 9(x + 1) + (x − 1) = 10x + 8, and the least is x + 1 + 9(x − 1) = 10x − 8.
TEST_F(ForcesCommandTest, ShowsThePoseAndTheWrenchThatIsNotHeld) {
  const CommandResult r =
      regulus({"check", model_, "--load", "push", "--range", "x=-0.7:-0.6", "--json"});
  EXPECT_EQ(r.exit_code, 1) << r.errors;
  const json report = json::parse(r.output);
  EXPECT_EQ(report["verdict"], "infeasible");
  const double x = report["witness"]["parameters"]["x"][0];
  EXPECT_GE(x, -0.7);
  EXPECT_LE(x, -0.6);
  EXPECT_EQ(report["witness"]["wrench"][0], json({2.0, 2.0}));
  const double y = report["witness"]["direction"][0];
  EXPECT_NEAR(report["witness"]["needed"][0].get<double>(), 2 * y, 1e-12);
  EXPECT_NEAR(report["witness"]["possible"][1].get<double>(), (10 * x + 8) * y, 1e-12);
}

TEST_F(ForcesCommandTest, PavesTheMotion) {
  const CommandResult r = regulus({"locate", model_, "--load", "push", "--range", "x=-2:2",
                                   "--resolution", "1/64", "--quiet", "--output", "-"});
  EXPECT_EQ(r.exit_code, 1) << r.errors;
  std::istringstream lines(r.output);
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(json::parse(line)["regulus_forces"], 1);
  double feasible = 0;
  json last;
  while (std::getline(lines, line)) {
    last = json::parse(line);
    if (!last.contains("kind")) continue;
    const double lo = last["box"]["x"][0], hi = last["box"]["x"][1];
    if (last["kind"] == "feasible") {
      feasible += hi - lo;
      EXPECT_GE(lo, -0.6);
      EXPECT_LE(hi, 0.6);
    } else if (last["kind"] == "infeasible") {
      EXPECT_TRUE(hi < -0.6 || lo > 0.6) << line;
    }
  }
  EXPECT_GT(feasible, 1.0);
  EXPECT_EQ(last["verdict"], "infeasible");
  EXPECT_GT(last["boxes_by_claim"]["infeasible"]["fraction"][0].get<double>(), 0.6);
}

/// The load is held where |x| < 0.6, and x goes from -0.5 to 0.9 and back to 0.
TEST_F(ForcesCommandTest, PavesWayPoints) {
  const std::string way = folder_.path() / "way.csv", lines = folder_.path() / "lines";
  std::ofstream(way) << "x\n-0.5\n0.9\n0.2\n0\n";
  const std::vector<std::string> question = {"locate",   model_, "--waypoints",  way,
                                             "--load",   "push", "--resolution", "1/256",
                                             "--output", lines,  "--json"};
  const CommandResult r = regulus(question);
  EXPECT_EQ(r.exit_code, 1) << r.errors;
  const json report = json::parse(r.output);
  EXPECT_EQ(report["verdict"], "infeasible");
  double sum = 0;
  for (const char* kind : {"feasible", "infeasible", "undecided", "outside"})
    sum += report["share"][kind].get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(report["share"]["infeasible"].get<double>(), (0.3 / 1.4 + 0.3 / 0.7) / 3, 0.01);
  EXPECT_LT(report["share"]["undecided"].get<double>(), 0.01);
  std::ifstream stretches(lines);
  std::string line;
  std::size_t count = 0;
  while (std::getline(stretches, line)) {
    const json stretch = json::parse(line);
    if (!stretch.contains("kind")) continue;
    ++count;
    const std::size_t first = stretch["segments"][0], last = stretch["segments"][1];
    if (stretch["kind"] == "feasible" && first == 1) {
      EXPECT_LE(stretch["s"][1], 1.1 / 1.4);
    }
    if (stretch["kind"] == "infeasible") {
      EXPECT_GE(stretch["s"][0], 1.1 / 1.4);
      EXPECT_LE(stretch["s"][1], 0.3 / 0.7);
      EXPECT_EQ(last, 2U);
    }
  }
  EXPECT_EQ(count, report["stretches"]);
  std::vector<std::string> proved = question;
  proved.insert(proved.end(), {"--certificate", folder_.path() / "proof"});
  EXPECT_EQ(regulus(proved).exit_code, 1);
  EXPECT_EQ(regulus({"verify", folder_.path() / "proof", "--quiet"}).output, "VERIFIED\n");
}

TEST_F(ForcesCommandTest, PavesWayPointsThatHoldTheLoad) {
  const std::string way = folder_.path() / "way.csv";
  std::ofstream(way) << "x\n-0.5\n0.5\n";
  const std::string proof = folder_.path() / "proof";
  const CommandResult r = regulus({"locate", model_, "--waypoints", way, "--load", "push",
                                   "--quiet", "--certificate", proof, "--output", "-"});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.output, HasSubstr("\"kind\":\"feasible\",\"segments\":[1,1]"));
  EXPECT_EQ(regulus({"verify", proof, "--quiet"}).output, "VERIFIED\n");
}

/// At x = 3/5 the load is at its limit: nothing moves, so nothing can be divided.
TEST_F(ForcesCommandTest, LeavesAPathThatStandsStillOpen) {
  const std::string way = folder_.path() / "way.csv", saved = folder_.path() / "saved";
  std::ofstream(way) << "x\n0.6\n0.6\n0.6\n";
  for (const char* command : {"check", "locate"}) {
    const CommandResult r = regulus(
        {command, model_, "--waypoints", way, "--load", "push", "--checkpoint", saved, "--json"});
    EXPECT_EQ(r.exit_code, 2) << r.errors;
    EXPECT_EQ(json::parse(r.output)["verdict"], "possible-problem");
  }
}

TEST_F(ForcesCommandTest, WritesProofsThatBothVerifiersAccept) {
  const std::string proof = folder_.path() / "proof";
  const auto verdicts = [&](std::vector<std::string> words, const std::string& range) {
    for (const char* word : {"--load", "push", "--certificate", proof.c_str(), "--json"})
      words.emplace_back(word);
    words.insert(words.end(), {"--range", range});
    EXPECT_EQ(json::parse(regulus(words).output)["certificate"], proof);
    const CommandResult own =
        regulus({"verify", proof, "--model", model_, "--allow-options", "--quiet"});
    const CommandResult other =
        run_command({kVerify, proof, "--model", model_, "--allow-options", "--quiet"});
    return own.output + other.output;
  };
  EXPECT_EQ(verdicts({"check", model_}, "x=-0.5:0.5"), "VERIFIED\nVERIFIED\n");
  EXPECT_EQ(verdicts({"check", model_}, "x=-0.7:0.7"), "VERIFIED\nVERIFIED\n");
  EXPECT_EQ(verdicts({"locate", model_}, "x=-0.7:0.7"), "VERIFIED\nVERIFIED\n");
  const json paving = json::parse(regulus({"verify", proof, "--json"}).output);
  EXPECT_GT(paving["paved"]["feasible"], 0);
  EXPECT_GT(paving["paved"]["infeasible"], 0);
  const CommandResult coq = run_command({kVerify, "--coq", folder_.path() / "proof.v", proof});
  EXPECT_EQ(coq.exit_code, 0) << coq.errors;
  std::ostringstream theorem;
  theorem << std::ifstream(folder_.path() / "proof.v").rdbuf();
  EXPECT_THAT(theorem.str(), HasSubstr("\nTheorem the_claim : forces_within_limits_in the_question "
                                       "the_parts the_scales the_load the_limits.\n"));
  // It keeps the middle of the range, and leaves out both ends.
  EXPECT_THAT(theorem.str(), HasSubstr("LeftOut Kept"));
  EXPECT_THAT(theorem.str(), HasSubstr("Kept LeftOut"));
}

TEST_F(ForcesCommandTest, WritesNoProofThatClaimsNothing) {
  const std::string proof = folder_.path() / "proof";
  const CommandResult r = regulus({"check", model_, "--load", "push", "--range", "x=-0.6:0.6",
                                   "--max-boxes", "1", "--certificate", proof});
  EXPECT_EQ(r.exit_code, 2) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("proof      none: POSSIBLE PROBLEM"));
  EXPECT_FALSE(std::ifstream(proof).good());
}

TEST_F(ForcesCommandTest, RefusesWhatHasNoMeaning) {
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    words.insert(words.begin(), {"check", model_, "--load", "push"});
    const CommandResult r = regulus(words);
    EXPECT_EQ(r.exit_code, 64) << r.errors;
    EXPECT_THAT(r.errors, HasSubstr(why));
    EXPECT_EQ(r.output, "");
  };
  refused({"--alpha", "0.1"}, "forces have no threshold");
  refused({"--method", "kj"}, "there is one method");
  const CommandResult unknown = regulus({"check", model_, "--load", "pull"});
  EXPECT_EQ(unknown.exit_code, 64);
  EXPECT_THAT(unknown.errors, HasSubstr("did you mean 'push'?"));
  EXPECT_EQ(regulus({"check", model_, "--load", ""}).exit_code, 64);  // which of the two?
}

/// Two cables more than the bead's: a paving of many boxes.
constexpr const char* kPlate = R"toml(regulus = 1
name = "plate"
[pose]
x = "m"
y = "m"
[matrix]
twist = ["v_x", "v_y"]
rows = [["x - 3", "y - 3"], ["x + 3", "y - 3"], ["x + 3", "y + 3"], ["x - 3", "y + 3"]]
row_scale = ["1/sqrt((x - 3)^2 + (y - 3)^2)", "1/sqrt((x + 3)^2 + (y - 3)^2)",
             "1/sqrt((x + 3)^2 + (y + 3)^2)", "1/sqrt((x - 3)^2 + (y + 3)^2)"]
[load.pull]
wrench = { value = [0, -2], radius = 1 }
[actuators]
force = [1, 10]
[motion.m]
x = ["-29/10", "29/10"]
y = ["-29/10", "29/10"]
constraints = ["x^2 + y^2 - 8"]
)toml";

class LoadCheckpoint : public ForcesCommandTest {
 protected:
  LoadCheckpoint() { std::ofstream(plate_) << kPlate; }

  [[nodiscard]] std::vector<std::string> words(const std::string& name,
                                               std::vector<std::string> more) const {
    std::vector<std::string> all{REGULUS_BINARY_DIR "/bin/regulus",
                                 "locate",
                                 plate_,
                                 "--load",
                                 "pull",
                                 "--resolution",
                                 "1/256",
                                 "--quiet",
                                 "--output",
                                 folder_.path() / (name + ".lines"),
                                 "--certificate",
                                 folder_.path() / (name + ".proof")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_.path() / name).rdbuf();
    return text.str();
  }
  /// Returns the boxes and the proof. The last line has times.
  [[nodiscard]] std::string files_of(const std::string& name) const {
    const std::string lines = text_of(name + ".lines");
    return lines.substr(0, lines.rfind('\n', lines.size() - 2)) + text_of(name + ".proof");
  }

  const std::string plate_ = folder_.path() / "plate.toml", saved_ = folder_.path() / "saved";
};

TEST_F(LoadCheckpoint, LeadsToTheSameBytes) {
  ASSERT_EQ(run_command(words("one", {"--threads", "1"})).exit_code, 1);
  const std::string expected = files_of("one");
  ASSERT_GT(expected.size(), 100'000U);
  ASSERT_EQ(run_command(words("two", {"--threads", "2"})).exit_code, 1);
  EXPECT_TRUE(files_of("two") == expected);
  for (const char* stop : {"1", "1000", "2001"}) {
    const CommandResult stopped =
        run_command(words("many", {"--max-boxes", stop, "--checkpoint", saved_}));
    EXPECT_EQ(stopped.exit_code, stop == std::string("1") ? 2 : 1) << stopped.errors;
    ASSERT_FALSE(text_of("saved").empty());
  }
  ASSERT_EQ(run_command(words("many", {"--checkpoint", saved_})).exit_code, 1);
  EXPECT_TRUE(files_of("many") == expected);
  EXPECT_EQ(text_of("saved"), "");  // there is nothing to continue
}

/// A kill may come before the search begins, while it is saved, or between.
TEST_F(LoadCheckpoint, SurvivesKills) {
  ASSERT_EQ(run_command(words("one", {"--threads", "1"})).exit_code, 1);
  std::mt19937 random(1);
  for (int kill = 0; kill < 5; ++kill) {
    RunningCommand running(
        words("many", {"--threads", "2", "--checkpoint", saved_, "--checkpoint-every", "0"}));
    for (int i = 0; text_of("saved").find("tree") == std::string::npos && i < 5000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 100));
    ::kill(running.pid(), SIGKILL);
    static_cast<void>(running.wait());
  }
  ASSERT_EQ(run_command(words("many", {"--checkpoint", saved_})).exit_code, 1);
  EXPECT_TRUE(files_of("many") == files_of("one"));
}

TEST_F(LoadCheckpoint, OfAnotherQuestionOrDamagedIsRefused) {
  ASSERT_EQ(run_command(words("many", {"--max-boxes", "300", "--checkpoint", saved_})).exit_code,
            1);
  const std::string saved = text_of("saved");
  const CommandResult other =
      regulus({"check", plate_, "--load", "pull", "--range", "x=0:1", "--checkpoint", saved_});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("it is about another question"));
  EXPECT_EQ(text_of("saved"), saved);
  const std::vector<std::string> splices{" ", "-", "=", "7", "0:1 ", "null", "{}", "\"", "1e9"};
  int refused = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::size_t tree = saved.find("\"tree\"");
    std::ofstream(saved_) << saved.substr(0, tree)
                          << Damage(seed, splices).done_to(saved.substr(tree));
    const CommandResult r =
        run_command(words("many", {"--max-boxes", "900", "--checkpoint", saved_}));
    if (r.exit_code != 65) {
      EXPECT_EQ(r.exit_code, 1) << seed << r.errors;
      continue;
    }
    EXPECT_THAT(r.errors, HasSubstr("the search cannot continue from this file")) << seed;
    ++refused;
  }
  EXPECT_GT(refused, 4);
}

TEST_F(ForcesCommandTest, StopsAtItsLimits) {
  const CommandResult r = regulus(
      {"check", model_, "--load", "push", "--range", "x=-0.6:0.6", "--max-boxes", "1", "--json"});
  EXPECT_EQ(r.exit_code, 2) << r.errors;
  EXPECT_EQ(json::parse(r.output)["boxes"], 1);
}

}  // namespace
}  // namespace regulus::detail::test
