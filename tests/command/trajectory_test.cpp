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
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

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

class Trajectories : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder_.path() / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
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
  const CommandResult verified = regulus({"verify", proof, "--model", model, "--allow-options"});
  EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
  EXPECT_THAT(verified.errors,
              HasSubstr("motion.way.error.y is '0', but the certificate has '99/100'"));
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
  const CommandResult unnamed = regulus({"verify", proof, "--model", kRobot1});
  EXPECT_EQ(unnamed.output, "UNFINISHED\n");
  EXPECT_THAT(unnamed.errors, HasSubstr("name it by --waypoints"));
}

/// The verifier's own reader of G-code finds each changed number, the plane and the direction.
TEST_F(Trajectories, OfGcodeAreComparedWithTheProgram) {
  const std::string proof = path("arc.txt");
  const std::string program =
      "%\n(circles)\nG21 G90 G17 F100\nG0 X80 Y0 Z550\ng3 x-80 y0 i-80 j0 ; half\nX80 Y0 I80.004\n"
      "G91 G1 X-80\nG18 G2 X0 Z0 I5 K-5.5\nG20 G1 X.1\nM30\nX5\n";
  const auto answer = [&](const std::string& from, const std::string& to) {
    std::string changed = program;
    changed.replace(changed.find(from), from.size(), to);
    const CommandResult run = run_command(
        {kVerify, proof, "--model", kRobot1, "--waypoints", file("changed.nc", changed)});
    EXPECT_THAT(run.errors, Not(HasSubstr("lines 'piece'")));
    return run.output;
  };
  const CommandResult run = regulus(
      {"check", kRobot1, "T1", "--waypoints", file("arc.nc", program), "--certificate", proof});
  ASSERT_EQ(run.output, "NO SINGULARITY\n") << run.errors;
  EXPECT_EQ(answer("%", ""), "VERIFIED\n");
  EXPECT_EQ(answer("M30\nX5", "X0"), "VERIFIED\n");
  for (const char* change : {"Z550|Z550.001", "g3|g2", "80.004|80.003", "K-5.5|K-5.4", "G20|",
                             "M30|", "j0|j.002", "G91 G1|G91 G3 I-40"})
    EXPECT_EQ(answer(std::string(change).substr(0, std::string(change).find('|')),
                     std::string(change).substr(std::string(change).find('|') + 1)),
              "REJECTED\n")
        << change;
  EXPECT_EQ(answer("g3", "g5"), "UNFINISHED\n");
  EXPECT_EQ(answer("G91 ", ""), "UNFINISHED\n");  // the ends of the arc are no longer on a circle
  EXPECT_EQ(answer("G18", ""), "UNFINISHED\n");   // K is no coordinate of the plane
  EXPECT_EQ(answer("F100", "G64"), "UNFINISHED\n");
  EXPECT_EQ(answer("F100", "G4 P1 F100"), "VERIFIED\n");
}

/// Slopes that are not those of the natural spline make another trajectory.
TEST_F(Trajectories, OfSplinesAreComparedWithTheirSlopes) {
  const std::string cubic = file("cubic.toml", kCart);
  std::string text = kCart;
  text.replace(text.find("\"cubic\""), 7, "\"hermite\"");
  const std::string hermite = file("hermite.toml", text);
  // The natural spline through (0, 1), (1, 2), (2, 1) has the slopes 3/2, 0, −3/2.
  const auto answer = [&](const std::string& slope) {
    static_cast<void>(
        file("way.csv", "t [s],x,y,dx,dy\n0,1,1,0," + slope + "\n1,1,2,0,0\n2,1,1,0,-1.5\n"));
    const std::string proof = path("proof.txt");
    EXPECT_EQ(regulus({"check", hermite, "curve", "--certificate", proof}).exit_code, 0);
    std::string certificate = file_contents(proof);
    const std::size_t sum = certificate.find("sha256 ") + 7;
    static_cast<void>(file("proof.txt", certificate.replace(sum, 64, "-")));
    return run_command({kVerify, proof, "--model", cubic}).output;
  };
  EXPECT_EQ(answer("1.5"), "VERIFIED\n");
  EXPECT_EQ(answer("1.500000000001"), "VERIFIED\n");
  EXPECT_EQ(answer("1.5001"), "REJECTED\n");
  EXPECT_EQ(answer("-1.5"), "REJECTED\n");
}

TEST_F(Trajectories, AreRejectedIfACertificateIsChanged) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const std::string proof = path("proof.txt");
  ASSERT_EQ(regulus({"check", model, "way", "--certificate", proof}).exit_code, 0);
  const std::string text = file_contents(proof);
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

TEST_F(Trajectories, AreNamedWhereAnotherQuestionHasNone) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  EXPECT_EQ(regulus({"check", model, "way", "--range", "x=0:1"}).exit_code, 64);
  for (const auto& [words, why] :
       {std::pair(std::vector<std::string>{"locate", "--picture", "way.vtu"},
                  "boxes in space need three motion parameters with ranges"),
        {{"locate", "--picture", "way.svg", "--axes", "x,y"}, "--axes: a motion along way-points"},
        {{"locate", "--picture", "way.svg", "--slices", "x=3"}, "has no ranges"},
        {{"locate", "--picture", "way.svg", "--shade", "share"}, "a row for each segment"},
        {{"margin", "--scale", "0:1"}, "has no ranges; use --tube"},
        {{"margin", "--grow", "x=0:1"}, "has no ranges; use --tube"}}) {
    std::vector<std::string> line = {words[0], model, "way"};
    line.insert(line.end(), words.begin() + 1, words.end());
    const CommandResult run = regulus(line);
    EXPECT_EQ(run.exit_code, 64);
    EXPECT_THAT(run.errors, HasSubstr(why));
  }
  std::filesystem::remove(path("way.csv"));
  EXPECT_EQ(regulus({"check", model, "way"}).exit_code, 74);
  EXPECT_EQ(regulus({"check", model, "hold", "--quiet"}).output, "NO SINGULARITY\n");
}

/// Row 117 is below the winches: the path crosses y = 0 before and behind it.
TEST_F(Trajectories, AreDividedIntoStretches) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle(117)));
  const CommandResult run = regulus({"locate", model, "way", "--output", path("stretches.jsonl"),
                                     "--certificate", path("proof.txt")});
  EXPECT_EQ(run.output, "SINGULARITY\n") << run.errors;
  EXPECT_EQ(regulus({"verify", path("proof.txt"), "--model", model}).output, "VERIFIED\n");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("free       segments 1 to 117, t from 0 to 1.169"));
  EXPECT_THAT(run.errors, HasSubstr("singular   segment 117, t from 1.169"));
  EXPECT_THAT(run.errors, HasSubstr("\npose       singular in segment 117, t = 1.169"));
  EXPECT_THAT(run.errors, HasSubstr("\nwitness    s = "));
  EXPECT_THAT(run.errors,
              HasSubstr("\nmeaning    free: the matrix loses rank at no pose of the stretch"));
  EXPECT_THAT(run.errors,
              HasSubstr("\nclaim      free: the full 2×2 matrix has full rank at every pose of the "
                        "stretch\n           singular: the full 2×2 matrix is singular at some"));
  std::vector<std::string> kinds;
  std::ifstream lines(path("stretches.jsonl"));
  double end = 0;
  json last;
  for (std::string line; std::getline(lines, line);) {
    last = json::parse(line);
    if (!last.contains("kind")) continue;
    kinds.push_back(last["kind"]);
    EXPECT_EQ(last["time"][0], end);
    end = last["time"][1];
  }
  EXPECT_EQ(end, 2);
  EXPECT_THAT(kinds, testing::ElementsAre("free", "singular", "free", "singular", "free"));
  EXPECT_GT(last["summary"]["share"]["free"], 0.9999);
  EXPECT_EQ(regulus({"locate", model, "hold", "--waypoints", file("good.csv", circle()), "--quiet",
                     "--certificate", path("free.txt")})
                .exit_code,
            0);
  EXPECT_EQ(regulus({"verify", path("free.txt"), "--model", model, "--waypoints", path("good.csv")})
                .output,
            "VERIFIED\n");
}

/// The singular way-point is the only one at x < 1.2.
TEST_F(Trajectories, ObeyConstraints) {
  const std::string limited = std::string(kCart) +
                              "[motion.right]\nwaypoints = \"way.csv\"\nconstraints = [\"1.2 - x\"]"
                              "\n[motion.none]\nwaypoints = \"way.csv\"\nconstraints = [\"x\"]\n";
  const std::string model = file("cart.toml", limited);
  static_cast<void>(file("way.csv", circle(100)));
  EXPECT_EQ(regulus({"check", model, "way", "--quiet"}).output, "SINGULARITY\n");
  const CommandResult run = regulus({"check", model, "right", "--certificate", path("proof.txt")});
  EXPECT_EQ(run.output, "NO SINGULARITY\n") << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("without a pose that the constraints allow: no part"));
  EXPECT_EQ(regulus({"verify", path("proof.txt"), "--model", model}).output, "VERIFIED\n");
  const json paved = json::parse(regulus({"locate", model, "right", "--json", "--quiet"}).output);
  EXPECT_EQ(paved["verdict"], "no-singularity");
  EXPECT_GT(paved["share"]["outside"], 0.05);
  const CommandResult none = regulus({"check", model, "none"});
  EXPECT_EQ(none.output, "POSSIBLE PROBLEM\n");
  EXPECT_THAT(none.errors, HasSubstr("the constraints exclude every pose"));
}

/// The lowest way-point of the circle is y = 1.
TEST_F(Trajectories, HaveMargins) {
  const std::string model = file("cart.toml", kCart);
  static_cast<void>(file("way.csv", circle()));
  const auto margin = [&](const std::string& motion, const std::string& option,
                          const std::string& range) {
    return regulus({"margin", model, motion, option, range, "--quiet"}).output;
  };
  EXPECT_EQ(margin("way", "--tube", "y=0:"), "SAFE UP TO 0.9925 m, NOT AT 1 m\n");
  EXPECT_EQ(margin("way", "--tube", "x=0:3"), "SAFE UP TO 3 m\n");
  EXPECT_EQ(margin("way", "--tolerance", "base=0:1"), "SAFE UP TO 1\n");
  EXPECT_THAT(margin("way", "--alpha", "0:8"), HasSubstr("SAFE UP TO 3.9"));
  EXPECT_EQ(margin("way", "--tube", "y=2:3"), "NOT SAFE AT 2 m\n");
  // The control error of a motion of another kind grows, too.
  EXPECT_EQ(margin("hold", "--tube", "y=0:"), "SAFE UP TO 0.9925 m, NOT AT 1 m\n");
}

/// The verifier's own reader of tables finds a changed number by itself.
TEST_F(Trajectories, AreComparedWithTheirTable) {
  const std::string model = file("cart.toml", kCart);
  const std::string table = circle();
  static_cast<void>(file("way.csv", table));
  for (const char* motion : {"way", "curve"}) {
    const std::string proof = path("proof.txt");
    ASSERT_EQ(regulus({"check", model, motion, "--certificate", proof}).exit_code, 0);
    const CommandResult same = run_command({kVerify, proof, "--model", model});
    EXPECT_EQ(same.output, "VERIFIED\n") << same.errors;
    EXPECT_THAT(same.errors, Not(HasSubstr("spline")));
    std::string changed = table;
    changed.replace(changed.find("3.000000"), 8, "3.000001");
    const CommandResult other = run_command(
        {kVerify, proof, "--model", model, "--waypoints", file("changed.csv", changed)});
    EXPECT_EQ(other.output, "REJECTED\n");
    EXPECT_THAT(other.errors, AllOf(HasSubstr("changed.csv"), HasSubstr("differs")));
    const CommandResult shorter =
        run_command({kVerify, proof, "--model", model, "--waypoints",
                     file("short.csv", table.substr(0, table.rfind('\n', table.size() - 2) + 1))});
    EXPECT_THAT(shorter.errors, HasSubstr("it has 200 pieces, the file 199"));
    EXPECT_EQ(run_command({kVerify, proof, "--model", model, "--waypoints",
                           file("odd.csv", "t,x,y\n0,one,2\n1,2,3\n")})
                  .output,
              "UNFINISHED\n");
  }
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
    const std::string text = file_contents(proof);
    EXPECT_TRUE(first.empty() || text == first);
    first = text;
  }
}

}  // namespace
}  // namespace regulus::detail::test
