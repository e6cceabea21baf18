// SPDX-License-Identifier: GPL-3.0-or-later
// Motions along the way-points of a file: verdicts, segments, certificates, and other questions
// that must be told from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kCommand = REGULUS_BINARY_DIR "/bin/regulus";
const std::string kVerify = REGULUS_BINARY_DIR "/bin/regulus-verify";
const std::string kRobot1 = REGULUS_SOURCE_DIR "/models/robot_1.toml";

/// A cart on two cables, which is singular at y = 0 and nowhere else.
constexpr const char* kCart = R"(regulus = 1
name = "cart on two cables"
[pose]
x = "m"
y = "m"
[geometry]
winch = { value = 4, tolerance = 0, group = "base" }
[matrix]
rows = [["x", "y"], ["x - winch", "y"]]
[motion.hold]
x = 1
y = 1
[motion.way]
waypoints = "way.csv"
[motion.curve]
waypoints = "way.csv"
interpolation = "cubic"
error = { y = 0.01 }
)";

std::string contents_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class Trajectories : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder_.path() / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  static CommandResult regulus(std::vector<std::string> words) {
    words.insert(words.begin(), kCommand);
    return run_command(words);
  }
  /// A circle of 200 way-points about (2, 2), but row `bad` is below the winches.
  static std::string circle(int bad = -1) {
    std::string text = "t [s],x [m],y [mm]\n";
    for (int k = 0; k <= 200; ++k) {
      const double angle = 2 * M_PI * k / 200;
      text += std::to_string(k * 0.01) + "," + std::to_string(2 + std::cos(angle)) + "," +
              std::to_string(k == bad ? -100.0 : 1000 * (2 + std::sin(angle))) + "\n";
    }
    return text;
  }

 private:
  TemporaryDirectory folder_;
};

TEST_F(Trajectories, AreProvedAndVerified) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  for (const char* motion : {"way", "curve"}) {
    const std::string proof = path(std::string(motion) + ".txt");
    const CommandResult run = regulus({"check", model, motion, "--certificate", proof});
    EXPECT_EQ(run.output, "NO SINGULARITY\n") << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("path       200 segments, "));
    EXPECT_THAT(run.errors, AllOf(HasSubstr("t in [0, 2] s, "), HasSubstr("way.csv\n")));
    const CommandResult verified = regulus({"verify", proof, "--model", model});
    EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
    EXPECT_THAT(verified.errors, HasSubstr("pieces     200 of a trajectory"));
    EXPECT_EQ(run_command({kVerify, proof}).exit_code, 0);
  }
}

TEST_F(Trajectories, NameTheSegmentAndTheTimeOfASingularPose) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle(117)));
  const CommandResult run =
      regulus({"check", model, "way", "--certificate", path("proof.txt"), "--json"});
  const json report = json::parse(run.output);
  EXPECT_EQ(report["verdict"], "singularity") << run.errors;
  EXPECT_EQ(report["segment"]["segment"], 117);
  EXPECT_EQ(report["segment"]["lines"], json({118, 119}));
  EXPECT_GT(report["segment"]["time"], 1.16);
  EXPECT_LT(report["segment"]["time"], 1.17);
  EXPECT_THAT(run.errors, HasSubstr("segment 117, t = 1.16"));
  EXPECT_THAT(run.errors, HasSubstr("way.csv, lines 118 and 119"));
  EXPECT_EQ(regulus({"verify", path("proof.txt"), "--model", model}).output, "VERIFIED\n");
}

TEST_F(Trajectories, HaveATubeOfErrors) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const auto verdict = [&](const std::string& tube) {
    return regulus({"check", model, "way", "--tube", tube, "--quiet"}).output;
  };
  EXPECT_EQ(verdict("0.9"), "NO SINGULARITY\n");
  EXPECT_EQ(verdict("y=1.1"), "SINGULARITY\n");
  EXPECT_EQ(verdict("x=1.1"), "NO SINGULARITY\n");
  const std::string proof = path("tube.txt");
  EXPECT_EQ(regulus({"check", model, "way", "--tube", "y=0.99", "--tolerance", "base=0.1",
                     "--certificate", proof})
                .output,
            "NO SINGULARITY\n");
  const CommandResult verified = regulus({"verify", proof, "--model", model});
  EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
  EXPECT_THAT(verified.errors, HasSubstr("tube y 99/100 instead of 0"));
}

TEST_F(Trajectories, OfAnotherFileAreFollowedForOneRun) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const std::string other = file("other.csv", "y\n1\n-1\n");
  const CommandResult run = regulus({"check", model, "hold", "--waypoints", other});
  EXPECT_EQ(run.output, "SINGULARITY\n") << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("singular   segment 1 ("));
  EXPECT_EQ(regulus({"check", model, "hold", "--waypoints", file("bad.csv", "y\n1\n")}).exit_code,
            65);
  const std::string arc = file("arc.nc", "G0 X3000 Y2000 Z0\nG2 X1000 Y2000 I-1000\n");
  EXPECT_THAT(regulus({"check", model, "hold", "--waypoints", arc}).errors,
              HasSubstr("the model has no such z"));
}

TEST_F(Trajectories, OfGcodeAreProvedAndVerified) {
  const std::string proof = path("arc.txt");
  const std::string program =
      file("arc.nc", "G0 X80 Y0 Z550\nG3 X-80 Y0 I-80 J0\nG3 X80 Y0 I80.004 J0\nG1 X0 Y0\n");
  const CommandResult run =
      regulus({"check", kRobot1, "T1", "--waypoints", program, "--certificate", proof});
  EXPECT_EQ(run.output, "NO SINGULARITY\n") << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("3 segments, G-code"));
  EXPECT_EQ(run_command({kVerify, proof}).output, "VERIFIED\n");
  const CommandResult compared =
      regulus({"verify", proof, "--model", kRobot1, "--waypoints", program});
  EXPECT_EQ(compared.output, "VERIFIED\n") << compared.errors;
  EXPECT_EQ(regulus({"verify", proof, "--model", kRobot1}).output, "REJECTED\n");
}

TEST_F(Trajectories, AreRejectedIfACertificateIsChanged) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const std::string proof = path("proof.txt");
  ASSERT_EQ(regulus({"check", model, "way", "--certificate", proof}).exit_code, 0);
  const std::string text = contents_of(proof);
  const auto answer = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    return regulus({"verify", file("changed.txt", changed), "--quiet"}).output;
  };
  EXPECT_EQ(answer("tree\n", "tree\n"), "VERIFIED\n");
  EXPECT_EQ(answer("tree\n", ""), "REJECTED\n");
  EXPECT_EQ(answer("tree\nl 0", "tree\ns 0 0 0x1p-1\nl 1"), "REJECTED\n");
  EXPECT_EQ(answer("piece 3 |", "piece |"), "REJECTED\n");
  EXPECT_EQ(answer("piece 3 | ", "piece 3 | 1 | "), "REJECTED\n");
  EXPECT_EQ(answer("\nend 200", "\nend 199"), "REJECTED\n");
  // Lower poses go through y = 0; another first piece is not that of the file.
  EXPECT_NE(answer("\npose y = ", "\npose y = -2 + "), "VERIFIED\n");
  std::string other = text;
  other.replace(other.find("piece 3 | "), 10, "piece 31/10 | ");
  const CommandResult compared = regulus({"verify", file("other.txt", other), "--model", model});
  EXPECT_EQ(compared.output, "REJECTED\n");
  EXPECT_THAT(compared.errors, HasSubstr("the certificate is not about"));
}

TEST_F(Trajectories, BelongToCheckAlone) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const CommandResult run = regulus({"locate", model, "way"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_THAT(run.errors, HasSubstr("only regulus check takes such a motion"));
  EXPECT_EQ(regulus({"check", model, "way", "--range", "x=0:1"}).exit_code, 64);
  std::filesystem::remove(path("way.csv"));
  EXPECT_EQ(regulus({"check", model, "way"}).exit_code, 74);
  EXPECT_EQ(regulus({"check", model, "hold", "--quiet"}).output, "NO SINGULARITY\n");
}

TEST_F(Trajectories, GiveTheSameCertificateForAnyNumberOfThreads) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  std::string first;
  for (const char* threads : {"1", "2"}) {
    const std::string proof = path(threads);
    ASSERT_EQ(regulus({"check", model, "curve", "--tube", "y=0.9", "--threads", threads,
                       "--certificate", proof})
                  .exit_code,
              0);
    const std::string text = contents_of(proof);
    EXPECT_TRUE(first.empty() || text == first);
    first = text;
  }
}

}  // namespace
}  // namespace regulus::test
