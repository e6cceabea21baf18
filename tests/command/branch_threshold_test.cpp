// SPDX-License-Identifier: GPL-3.0-or-later
// The threshold of a closure from the command: |det| of a four-bar linkage is coupler·rocker·|sin(φ − ψ)|.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/interrupted_runs.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class ThresholdOfAFourBar : public testing::Test {
 protected:
  /// By the law of cosines in the triangle of coupler, rocker and diagonal: twice its area.
  static double determinant(double theta) {
    constexpr double kGround = 0.45, kCrank = 0.2, kCoupler = 0.35355, kRocker = 0.25;
    const double squared =
        kGround * kGround + kCrank * kCrank - 2 * kGround * kCrank * std::cos(theta);
    const double cosine =
        (kCoupler * kCoupler + kRocker * kRocker - squared) / (2 * kCoupler * kRocker);
    return kCoupler * kRocker * std::sqrt(1 - cosine * cosine);
  }
  /// The least one from −1 to 1.
  static double least_of_swing() {
    double least = INFINITY;
    for (int i = 0; i <= 2000; ++i) least = std::fmin(least, determinant(i * 1e-3 - 1));
    return least;
  }

  ThresholdOfAFourBar() { write_model(""); }

  /// The model without the control error of `swing`, and with this line in its place.
  void write_model(const std::string& line) const {
    const std::string error = "error = { theta = \"0.5*deg\" }\n";
    std::string text = file_contents(REGULUS_SOURCE_DIR "/models/four_bar.toml");
    text.replace(text.find(error), error.size(), line);
    std::ofstream(model_) << text;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
  /// Asks about the motion `swing`.
  [[nodiscard]] CommandResult ask(const std::string& command, const Words& more) const {
    Words words{REGULUS_BINARY_DIR "/bin/regulus", command, model_, "swing", "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  [[nodiscard]] CommandResult along(const std::string& command, const Words& more) const {
    Words words{"--waypoints", path("way.csv")};
    words.insert(words.end(), more.begin(), more.end());
    return ask(command, words);
  }
  [[nodiscard]] CommandResult verify(const std::string& proof, const Words& more = {}) const {
    Words words{REGULUS_BINARY_DIR "/bin/regulus", "verify", proof, "--model", model_};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  const TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "model.toml";
};

TEST_F(ThresholdOfAFourBar, IsProvedOrRefuted) {
  const double least = least_of_swing();
  const auto check = [&](double part) {
    return ask("check",
               {"--alpha", std::to_string(part * least), "--certificate", path("proof"), "--json"});
  };
  const CommandResult safe = check(0.99);
  ASSERT_EQ(safe.exit_code, 0) << safe.errors;
  const json report = json::parse(safe.output);
  EXPECT_THAT(std::string(report.at("claim")),
              HasSubstr("|det| of its 2×2 matrix of the equations' derivatives is more than 0.0"));
  EXPECT_NEAR(double(report.at("alpha")), 0.99 * least, 1e-6);
  EXPECT_TRUE(report.at("witness").is_null());
  EXPECT_EQ(verify(path("proof"), {"--allow-options"}).exit_code, 0);
  // The file has no threshold, so the proof is about another question.
  const CommandResult strict = verify(path("proof"));
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.errors, HasSubstr("alpha"));
  const CommandResult unsafe = check(1.01);
  ASSERT_EQ(unsafe.exit_code, 1) << unsafe.errors;
  const json refuted = json::parse(unsafe.output);
  const json& point = refuted.at("witness").at("points").at(0);
  const double theta = point.at("parameters").at("theta").at(0);
  EXPECT_NEAR(std::fabs(double(point.at("determinant").at(0))), determinant(theta), 1e-9);
  EXPECT_LE(determinant(theta), 1.01 * least);
  EXPECT_EQ(verify(path("proof"), {"--allow-options"}).exit_code, 0);
}

/// The threshold stands in the model file: each proof is compared with it.
TEST_F(ThresholdOfAFourBar, IsThatOfTheFile) {
  const auto run = [&](const Words& words) {
    Words all{REGULUS_BINARY_DIR "/bin/regulus"};
    all.insert(all.end(), words.begin(), words.end());
    return run_command(all).exit_code;
  };
  write_model("alpha = \"1/17\"\n");
  ASSERT_EQ(run({"check", model_, "swing", "--certificate", path("proof")}), 0);
  EXPECT_THAT(file_contents(path("proof")), HasSubstr("\nalpha 1/17\n"));
  const Words verify{"verify", path("proof"), "--model", model_};
  EXPECT_EQ(run(verify), 0);
  // A bound and a load have no threshold.
  EXPECT_EQ(run({"bound", model_, "swing", "determinant", "--certificate", path("bound")}), 0);
  EXPECT_EQ(run({"verify", path("bound.safe"), "--model", model_}), 0);
  write_model("alpha = 0.0589\n");
  EXPECT_EQ(run(verify), 1);
  write_model("");
  EXPECT_EQ(run(verify), 1);
  ASSERT_EQ(run({"check", model_, "swing", "--certificate", path("proof")}), 0);
  write_model("alpha = 1e-3\n");
  EXPECT_EQ(run(verify), 1);
}

TEST_F(ThresholdOfAFourBar, HasAMarginAroundTheClosedForm) {
  const double least = least_of_swing();
  std::ofstream(path("way.csv")) << "theta\n0\n1\n-1\n";
  for (const bool is_along : {false, true}) {
    const Words words{"--alpha", "0:1", "--gap", "1e-3", "--certificate", path("proof"), "--json"};
    const CommandResult run = is_along ? along("margin", words) : ask("margin", words);
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_LE(double(report.at("certified")), least);
    EXPECT_GE(double(report.at("refuted")), least);
    EXPECT_LE(double(report.at("gap")), 1e-3);
    const json& point = report.at("witness").at("points").at(0);
    EXPECT_LE(std::fabs(double(point.at("determinant").at(0))), double(report.at("refuted")));
    Words more{"--allow-options"};
    if (is_along) more.insert(more.end(), {"--waypoints", path("way.csv")});
    for (const char* end : {".safe", ".singular"})
      EXPECT_EQ(verify(path("proof") + end, more).exit_code, 0) << end;
  }
}

TEST_F(ThresholdOfAFourBar, IsLocated) {
  const double alpha = 0.07;
  const CommandResult run = ask("locate", {"--alpha", "0.07", "--resolution", "1/200", "--output",
                                           path("lines"), "--certificate", path("proof")});
  ASSERT_EQ(run.exit_code, 1) << run.errors;
  EXPECT_EQ(verify(path("proof"), {"--allow-options"}).exit_code, 0);
  std::istringstream lines(file_contents(path("lines")));
  int free = 0, singular = 0;
  for (std::string line; std::getline(lines, line);) {
    const json box = json::parse(line);
    if (!box.contains("kind") || !box.contains("box")) continue;
    const json& range = box.at("box").at("theta");
    const double lo = range.at(0), hi = range.at(1);
    for (const double theta : {lo, (lo + hi) / 2, hi}) {
      const bool is_free = box.at("kind") == "free", is_singular = box.at("kind") == "singular";
      EXPECT_TRUE(!is_free || determinant(theta) > alpha) << theta;
      EXPECT_TRUE(!is_singular || determinant(theta) <= alpha) << theta;
      free += is_free, singular += is_singular;
    }
  }
  EXPECT_GT(free, 0) << file_contents(path("lines"));
  EXPECT_GT(singular, 0);
}

TEST_F(ThresholdOfAFourBar, ContinuesAndGoesInShards) {
  std::ofstream(path("way.csv")) << "theta\n0\n1\n-1\n";
  for (const bool is_along : {false, true}) {
    const auto check = [&](const std::string& name, const Words& more) {
      Words words{"--alpha", std::to_string(0.9999 * least_of_swing()), "--certificate",
                  path(name)};
      words.insert(words.end(), more.begin(), more.end());
      return is_along ? along("check", words) : ask("check", words);
    };
    const CommandResult whole = check("whole", {});
    ASSERT_EQ(whole.exit_code, 0) << whole.errors;
    for (const char* most : {"3", "12", "20"})
      EXPECT_EQ(check("part", {"--checkpoint", path("saved"), "--max-boxes", most}).exit_code, 2);
    EXPECT_EQ(check("part", {"--checkpoint", path("saved")}).exit_code, 0);
    EXPECT_TRUE(file_contents(path("part")) == file_contents(path("whole")));
    EXPECT_EQ(check("shards", {"--shard-size", "4kiB"}).exit_code, 0);
    EXPECT_THAT(file_contents(path("shards")), HasSubstr("regulus-certificate-index"));
    Words more{"--allow-options"};
    if (is_along) more.insert(more.end(), {"--waypoints", path("way.csv")});
    EXPECT_EQ(verify(path("shards"), more).exit_code, 0);
  }
}

/// The theorem is about the determinant, and not about the branch alone; one that is at most the threshold
/// has none.
TEST_F(ThresholdOfAFourBar, IsATheoremAboutTheDeterminant) {
  const auto written = [&](const char* alpha) {
    static_cast<void>(ask("check", {"--alpha", alpha, "--certificate", path("proof")}));
    return run_command(
        {REGULUS_BINARY_DIR "/bin/regulus-verify", "--coq", path("proof.v"), path("proof")});
  };
  const CommandResult above = written("0.06");
  EXPECT_EQ(above.exit_code, 0) << above.errors;
  const std::string text = file_contents(path("proof.v"));
  EXPECT_THAT(text, HasSubstr("Definition the_side : side := Beyond."));
  EXPECT_THAT(text, HasSubstr("branch_determinant the_closure the_side the_limit"));
  std::filesystem::remove(path("proof.v"));
  const CommandResult below = written("0.08");
  EXPECT_NE(below.exit_code, 0);
  EXPECT_THAT(below.errors, HasSubstr("no theorem yet"));
  EXPECT_FALSE(std::filesystem::exists(path("proof.v")));
}

TEST_F(ThresholdOfAFourBar, HasAPage) {
  ASSERT_EQ(ask("check", {"--alpha", "0.06", "--page", path("page.html")}).exit_code, 0);
  EXPECT_THAT(file_contents(path("page.html")), HasSubstr("is more than 0.06"));
  ASSERT_EQ(ask("locate", {"--alpha", "0.07", "--page", path("page.html")}).exit_code, 1);
}

}  // namespace
}  // namespace regulus::detail::test
