// SPDX-License-Identifier: GPL-3.0-or-later
// Margins along the way-points of a file: their proofs, their checkpoints and limits.
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

namespace regulus::detail::test::way_margin {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
[motion.way]
waypoints = "circle.csv"
)";

/// J⁻¹ = [1 x; 0 1] on 0 ≤ x ≤ 2.
constexpr const char* kShear = R"toml(regulus = 1
name = "shear"
[pose]
x = "cm"
y = "cm"
[matrix]
rows = [["x + 3", "x*(x + 3)"], [0, 2]]
row_scale = ["1/(x + 3)", "1/2"]
[load.any]
force = [[-1, 1], [-1, 1]]
[twist.along]
velocity = [1, 1]
[motion.way]
waypoints = "way.csv"
y = 0
)toml";

/// A circle of 100 way-points about (2, 2), but row `bad` is below the winches.
std::string circle(int bad = -1) {
  std::string text = "t [s],x [m],y [m]\n";
  for (int k = 0; k <= 100; ++k) {
    const double angle = 2 * M_PI * k / 100;
    text += std::to_string(k * 0.02) + "," + std::to_string(2 + std::cos(angle)) + "," +
            std::to_string(k == bad ? -0.1 : 2 + std::sin(angle)) + "\n";
  }
  return text;
}

class WayMargin : public testing::Test {
 protected:
  WayMargin() {
    cart_ = file("cart.toml", kCart);
    shear_ = file("shear.toml", kShear);
    file("circle.csv", circle());
    file("way.csv", "t [s],x [cm]\n0,0\n1,0.5\n2,1\n3,1.25\n4,2\n");
  }

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  static CommandResult regulus(std::vector<std::string> words) {
    words.insert(words.begin(), REGULUS_BINARY_DIR "/bin/regulus");
    if (words[1] == "margin") words.insert(words.end(), {"--threads", "1"});
    return run_command(words);
  }
  static bool proves(const std::string& proof) {
    return run_command({REGULUS_BINARY_DIR "/bin/regulus-verify", proof}).exit_code == 0;
  }

  std::string cart_, shear_;

 private:
  TemporaryDirectory folder_;
};

TEST_F(WayMargin, HasProofsOfBothEnds) {
  const std::string proof = path("proof");
  for (const std::vector<std::string>& grows :
       {std::vector<std::string>{"--tube", "y=0:"}, {"--alpha", "0:8"}}) {
    std::vector<std::string> words = {"margin", cart_, "way", "--certificate", proof, "--json"};
    words.insert(words.end(), grows.begin(), grows.end());
    const CommandResult run = regulus(words);
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("proof.safe: safe at "));
    EXPECT_EQ(json::parse(run.output)["certificates"]["singular"], proof + ".singular");
    for (const char* end : {".safe", ".singular"}) {
      EXPECT_TRUE(proves(proof + end)) << end;
      const CommandResult compared =
          regulus({"verify", proof + end, "--model", cart_, "--allow-options"});
      EXPECT_EQ(compared.exit_code, 0) << end << compared.errors;
    }
    std::string text = file_contents(proof + ".safe");
    const std::size_t leaf = text.rfind("\nl ");
    text.erase(leaf, text.find('\n', leaf + 1) - leaf);
    EXPECT_FALSE(proves(file("shorter", text)));
  }
  // A margin that is safe up to its end has no other proof; one that is not safe has no first.
  const CommandResult safe =
      regulus({"margin", cart_, "way", "--tube", "x=0:3", "--certificate", path("all")});
  EXPECT_THAT(safe.errors, HasSubstr("none for the singular end: no singularity was found"));
  EXPECT_TRUE(std::filesystem::exists(path("all.safe")));
  EXPECT_FALSE(std::filesystem::exists(path("all.singular")));
}

/// det = (4 - e)·y, and the lowest way-point is y = 1.
TEST_F(WayMargin, KeepsALimitOfADeterminant) {
  const CommandResult run =
      regulus({"margin", cart_, "way", "--tolerance", "base=0:2", "--quantity", "determinant",
               "--limit", "3", "--gap", "1e-3", "--certificate", path("proof"), "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_LE(double(report["certified"]), 1);
  EXPECT_GE(double(report["refuted"]), 1);
  EXPECT_LE(double(report["gap"]), 1e-3);
  for (const char* end : {".safe", ".singular"}) EXPECT_TRUE(proves(path("proof") + end)) << end;
}

/// As if the run had been killed after some of its searches.
TEST_F(WayMargin, ContinuesFromItsCheckpoint) {
  const std::string saved = path("saved");
  const auto ask = [&](const std::string& certificate) {
    return regulus({"margin", cart_, "way", "--tube", "y=0:", "--checkpoint", saved,
                    "--certificate", certificate, "--json"});
  };
  const CommandResult whole = ask(path("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const json searches = json::parse(file_contents(saved));
  ASSERT_EQ(searches["known"]["brackets"].size(), 1U);
  const json& bracket = searches["known"]["brackets"].front();
  ASSERT_GT(bracket.size(), 3U);
  for (std::size_t kept = 0; kept <= bracket.size(); ++kept) {
    json part = searches;
    json& some = part["known"]["brackets"].front();
    while (some.size() > kept) some.erase(std::prev(some.end()).key());
    file("saved", part.dump());
    const CommandResult run = ask(path("part"));
    const json report = json::parse(run.output), first = json::parse(whole.output);
    for (const char* key : {"bracket", "certified_claim", "boxes", "closed"})
      EXPECT_EQ(report[key], first[key]) << key << kept;
    for (const char* end : {".safe", ".singular"})
      EXPECT_TRUE(file_contents(path("part") + end) == file_contents(path("whole") + end)) << kept;
  }
  file("circle.csv", circle(3));
  const CommandResult other = ask(path("other"));
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("another question"));
}

/// The largest speed of leg 1 is 1 + x, at x = 2 + e in a tube of ±e.
TEST_F(WayMargin, KeepsALimitOfASpeed) {
  const std::string proof = path("proof"), saved = path("saved");
  const auto ask = [&](const std::string& certificate) {
    return regulus({"margin", shear_, "way", "--tube", "x=0:2", "--quantity", "speed", "--leg", "1",
                    "--limit", "3.5", "--gap", "1e-3", "--certificate", certificate, "--checkpoint",
                    saved, "--json"});
  };
  const CommandResult run = ask(proof);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_LE(double(report["certified"]), 0.5);
  EXPECT_GE(double(report["refuted"]), 0.5);
  EXPECT_LE(double(report["gap"]), 1e-3);
  EXPECT_THAT(run.errors, HasSubstr("exceeded   leg 1: segment 4, t = 4"));
  EXPECT_EQ(report["components"][0]["place"]["segment"]["segment"], 4);
  EXPECT_TRUE(proves(proof + ".leg_1.safe"));
  EXPECT_TRUE(proves(proof + ".leg_1.singular"));
  EXPECT_EQ(
      regulus({"verify", proof + ".leg_1.safe", "--model", shear_, "--allow-options"}).exit_code,
      0);
  const json again = json::parse(ask(path("again")).output);
  for (const char* key : {"bracket", "boxes"}) EXPECT_EQ(again[key], report[key]) << key;
  EXPECT_TRUE(proves(path("again.leg_1.safe")));
}

TEST_F(WayMargin, KeepsALimitOfEveryLeg) {
  const CommandResult run = regulus(
      {"margin", shear_, "way", "--tube", "x=0:2", "--quantity", "speed", "--limit", "3.5"});
  EXPECT_THAT(run.output,
              testing::MatchesRegex("WITHIN UP TO 0.49.*, EXCEEDED AT 0.5.* .leg 1.\n"));
  const CommandResult never = regulus({"margin", shear_, "way", "--tube", "x=0:0.1", "--quantity",
                                       "force", "--load", "any", "--limit", "50"});
  EXPECT_EQ(never.output, "WITHIN UP TO 0.1 cm\n") << never.errors;
  const CommandResult at_once = regulus(
      {"margin", shear_, "way", "--tube", "x=0:1", "--quantity", "speed", "--limit", "2.5"});
  EXPECT_EQ(at_once.exit_code, 1);
  EXPECT_THAT(at_once.output, HasSubstr("EXCEEDED AT 0"));
  const CommandResult kappa = regulus({"margin", shear_, "way", "--tube", "x=0:1", "--quantity",
                                       "condition", "--norm", "2", "--limit", "9"});
  EXPECT_EQ(kappa.exit_code, 64);
}

}  // namespace
}  // namespace regulus::detail::test::way_margin
