// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `regulus check --load` and `regulus locate --load` as users see them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
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
  EXPECT_THAT(r.errors,
              HasSubstr("proved     at every pose of the variety, forces within [1, 9] kN "
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
  const CommandResult r = regulus(
      {"locate", model_, "--load", "push", "--range", "x=-2:2", "--resolution", "1/64", "--quiet"});
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

TEST_F(ForcesCommandTest, WritesProofsThatBothVerifiersAccept) {
  const std::string proof = folder_.path() / "proof";
  const auto verdicts = [&](std::vector<std::string> words, const std::string& range) {
    for (const char* word : {"--load", "push", "--certificate", proof.c_str(), "--json"})
      words.emplace_back(word);
    words.insert(words.end(), {"--range", range});
    EXPECT_EQ(json::parse(regulus(words).output)["certificate"], proof);
    const CommandResult own = regulus({"verify", proof, "--model", model_, "--quiet"});
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
  EXPECT_NE(coq.exit_code, 0);
  EXPECT_THAT(coq.errors, HasSubstr("cannot be written as a theorem"));
}

TEST_F(ForcesCommandTest, WritesNoProofThatClaimsNothing) {
  const std::string proof = folder_.path() / "proof";
  const CommandResult r = regulus({"check", model_, "--load", "push", "--range", "x=-0.6:0.6",
                                   "--max-boxes", "1", "--certificate", proof});
  EXPECT_EQ(r.exit_code, 2) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("certificate none: POSSIBLE PROBLEM"));
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
  refused({"--certificate", "proof", "--shard-size", "64kB"}, "stays in one file");
  refused({"--checkpoint", "saved"}, "cannot be continued");
  refused({"--alpha", "0.1"}, "forces have no threshold");
  refused({"--method", "kj"}, "there is one method");
  const CommandResult unknown = regulus({"check", model_, "--load", "pull"});
  EXPECT_EQ(unknown.exit_code, 64);
  EXPECT_THAT(unknown.errors, HasSubstr("did you mean 'push'?"));
  EXPECT_EQ(regulus({"check", model_, "--load", ""}).exit_code, 64);  // which of the two?
}

TEST_F(ForcesCommandTest, StopsAtItsLimits) {
  const CommandResult r = regulus(
      {"check", model_, "--load", "push", "--range", "x=-0.6:0.6", "--max-boxes", "1", "--json"});
  EXPECT_EQ(r.exit_code, 2) << r.errors;
  EXPECT_EQ(json::parse(r.output)["boxes"], 1);
}

}  // namespace
}  // namespace regulus::test
