// SPDX-License-Identifier: GPL-3.0-or-later
// Closures along the way-points of a file: margins with proofs and checkpoints, pavings, pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support/bars.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/interrupted_runs.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr const char* kFourBar = REGULUS_SOURCE_DIR "/models/four_bar.toml";
/// Coupler and rocker of the model are in line there.
const double kToggle =
    std::acos((0.2 * 0.2 + 0.45 * 0.45 - std::pow(0.35355 + 0.25, 2)) / (2 * 0.2 * 0.45));

class BranchOnWay : public testing::Test {
 protected:
  BranchOnWay() { write_way("0\n100\n-120\n130\n0\n"); }

  void write_way(const std::string& places) const {
    std::ofstream(way_) << "theta [deg]\n" << places;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
  /// Asks about the motion without errors.
  [[nodiscard]] CommandResult ask(const std::string& command, const Words& more) const {
    Words words{REGULUS_BINARY_DIR "/bin/regulus",
                command,
                kFourBar,
                "turn",
                "--waypoints",
                way_,
                "--threads",
                "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  [[nodiscard]] int verified(const std::string& proof) const {
    return run_command({REGULUS_BINARY_DIR "/bin/regulus", "verify", proof, "--model", kFourBar,
                        "--waypoints", way_, "--allow-options"})
        .exit_code;
  }

  const TemporaryDirectory folder_;
  const std::string way_ = folder_.path() / "way.csv";
};

/// The crank is nearest to a toggle at 130 deg, where the third segment ends.
TEST_F(BranchOnWay, HasErrorsUpToTheToggle) {
  const double room = kToggle - 130 * std::numbers::pi / 180;
  const CommandResult run = ask("margin", {"--tube", "theta=0:0.2", "--gap", "1e-3",
                                           "--certificate", path("proof"), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_LE(double(report.at("certified")), room);
  EXPECT_GE(double(report.at("refuted")), room);
  EXPECT_LE(double(report.at("gap")), 1e-3);
  EXPECT_EQ(report.at("segment").at("segment"), 3);
  for (const char* end : {".safe", ".singular"}) EXPECT_EQ(verified(path("proof") + end), 0) << end;
  // The proofs are of this way alone.
  write_way("0\n100\n-120\n131\n0\n");
  for (const char* end : {".safe", ".singular"}) EXPECT_EQ(verified(path("proof") + end), 1) << end;
}

/// Bars that are longer or shorter by e are in line where the ranges of check say it, too.
TEST_F(BranchOnWay, HasTheTolerancesOfTheMotionThatItCovers) {
  write_way("0\n130\n-130\n");
  const CommandResult along = ask("margin", {"--tolerance", "links=0:", "--gap", "1e-2", "--json"});
  const CommandResult over =
      run_command({REGULUS_BINARY_DIR "/bin/regulus", "margin", kFourBar, "turn", "--range",
                   "theta=-130*deg:130*deg", "--tolerance", "links=0:", "--gap", "1e-2",
                   "--threads", "1", "--json"});
  ASSERT_EQ(along.exit_code, 0) << along.errors;
  ASSERT_EQ(over.exit_code, 0) << over.errors;
  const json a = json::parse(along.output), b = json::parse(over.output);
  EXPECT_LE(double(a.at("certified")), double(b.at("refuted")));
  EXPECT_LE(double(b.at("certified")), double(a.at("refuted")));
}

/// As if the run had been killed after some of its searches.
TEST_F(BranchOnWay, ContinuesAMargin) {
  const auto margin = [this](const std::string& certificate) {
    return ask("margin", {"--tube", "theta=0:0.2", "--certificate", certificate, "--checkpoint",
                          path("saved"), "--json"});
  };
  const CommandResult whole = margin(path("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const json searches = json::parse(file_contents(path("saved")));
  ASSERT_EQ(searches.at("known").at("brackets").size(), 1U);
  const std::size_t count = searches.at("known").at("brackets").front().size();
  ASSERT_GT(count, 3U);
  for (std::size_t kept = 0; kept <= count; ++kept) {
    json part = searches;
    json& some = part.at("known").at("brackets").front();
    while (some.size() > kept) some.erase(std::prev(some.end()).key());
    std::ofstream(path("saved")) << part.dump();
    const CommandResult run = margin(path("part"));
    const json report = json::parse(run.output), first = json::parse(whole.output);
    for (const char* key : {"bracket", "certified_claim", "boxes", "closed"})
      EXPECT_EQ(report.at(key), first.at(key)) << key << kept;
    for (const char* end : {".safe", ".singular"})
      EXPECT_TRUE(file_contents(path("part") + end) == file_contents(path("whole") + end))
          << end << kept;
  }
  write_way("0\n100\n-120\n131\n0\n");
  const CommandResult other = margin(path("other"));
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("another question"));
}

TEST_F(BranchOnWay, IsPavedUpToItsEnd) {
  write_way("0\n100\n-120\n140\n0\n");
  const CommandResult run = ask("locate", {"--output", path("lines"), "--json"});
  EXPECT_EQ(run.exit_code, 1) << run.errors;
  const json report = json::parse(run.output);
  const double at = (kToggle * 180 / std::numbers::pi + 120) / 260;
  EXPECT_EQ(report.at("segment").at("segment"), 3);
  EXPECT_NEAR(double(report.at("segment").at("s").at(0)), at, 1e-9);
  std::istringstream lines(file_contents(path("lines")));
  std::string free, undecided;
  std::getline(lines, free);
  std::getline(lines, undecided);
  const json certain = json::parse(free);
  EXPECT_EQ(certain.at("kind"), "free");
  EXPECT_EQ(certain.at("segments"), json({1, 3}));
  EXPECT_LE(double(certain.at("s").at(1)), at);
  EXPECT_GE(double(certain.at("s").at(1)), at - 1.0 / 64);
  EXPECT_EQ(json::parse(undecided).at("segments"), json({3, 4}));
  // The proof says up to where the branch is certain.
  EXPECT_EQ(ask("locate", {"--certificate", path("proof")}).exit_code, 1);
  EXPECT_THAT(file_contents(path("proof")), HasSubstr("\nverdict PAVING\n"));
  EXPECT_EQ(verified(path("proof")), 0);
  write_way("0\n100\n-120\n141\n0\n");
  EXPECT_EQ(verified(path("proof")), 1);
  const CommandResult theorem = run_command(
      {REGULUS_BINARY_DIR "/bin/regulus-verify", "--coq", path("proof.v"), path("proof")});
  EXPECT_EQ(theorem.exit_code, 0) << theorem.errors;
  // The branch is kept up to the third segment, and on a part of that.
  const std::string kept =
      "[(* piece 1 *) Kept;\n   (* piece 2 *) Kept;\n   (* piece 3 *) Parted 0 ";
  EXPECT_THAT(file_contents(path("proof.v")), HasSubstr(kept));
  EXPECT_THAT(file_contents(path("proof.v")),
              HasSubstr(" Kept LeftOut;\n   (* piece 4 *) LeftOut]"));
  EXPECT_THAT(
      file_contents(path("proof.v")),
      HasSubstr("\nTheorem the_claim : one_branch_along_in the_closure pieces the_parts.\n"));
}

/// The first segment is excluded, so that the way has no branch to follow.
TEST_F(BranchOnWay, IsNotFollowedWhereItHasNoPose) {
  std::ofstream(path("model.toml"))
      << "regulus = 1\nname = \"slider\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { p = \"m\" }\n"
         "equations = [\"p^2 - x - 1\"]\nstart = { x = 0, p = 1 }\n[motion.m]\n"
         "waypoints = \"x.csv\"\nconstraints = [\"x - 1/2\"]\nerror = { x = 0.01 }\n";
  std::ofstream(path("x.csv")) << "x\n0\n0.25\n0.75\n2\n3\n";
  const Words words{REGULUS_BINARY_DIR "/bin/regulus",
                    "locate",
                    path("model.toml"),
                    "m",
                    "--output",
                    path("lines"),
                    "--json"};
  const CommandResult run = run_command(words);
  EXPECT_EQ(run.exit_code, 2) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("the constraints exclude every pose of the segment"));
  const std::string lines = file_contents(path("lines"));
  EXPECT_THAT(lines, HasSubstr("{\"kind\":\"free\",\"segments\":[1,2]"));
  EXPECT_THAT(lines, HasSubstr("{\"kind\":\"undecided\",\"segments\":[4,4]"));
  Words margin = words;
  margin[1] = "margin";
  margin.resize(4);
  margin.insert(margin.end(), {"--tube", "x=0:0.5"});
  const CommandResult grown = run_command(margin);
  EXPECT_EQ(grown.exit_code, 2) << grown.output;
  EXPECT_THAT(grown.output, HasSubstr("NOTHING KNOWN FROM 0 m ON"));
}

TEST_F(BranchOnWay, HasPages) {
  const auto page_of = [this](const std::string& command, const Words& more) {
    Words words = more;
    words.insert(words.end(), {"--page", path("page.html")});
    EXPECT_LE(ask(command, words).exit_code, 1);
    return file_contents(path("page.html"));
  };
  EXPECT_THAT(page_of("check", {}), HasSubstr("piecewise"));
  EXPECT_THAT(page_of("check", {}), HasSubstr("NO SINGULARITY"));
  EXPECT_THAT(page_of("margin", {"--tube", "theta=0:0.2"}), HasSubstr("SAFE UP TO"));
  EXPECT_THAT(page_of("locate", {}), HasSubstr("stretches"));
}

/// The bars have errors, loads and motors.
class BarsOnWay : public BranchOnWay {
 protected:
  BarsOnWay() {
    write_bars("[-1000, 1000]");
    write_way("0\n-10\n-40\n");
  }
  void write_bars(const std::string& force) const {
    std::ofstream(path("bars.toml")) << bars("0.002", force);
  }
  [[nodiscard]] CommandResult ask_bars(const std::string& command, const Words& more) const {
    Words words{REGULUS_BINARY_DIR "/bin/regulus",
                command,
                path("bars.toml"),
                "m",
                "--waypoints",
                way_,
                "--threads",
                "1",
                "--json",
                "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  [[nodiscard]] CommandResult verify_bars(const std::string& proof) const {
    return run_command({REGULUS_BINARY_DIR "/bin/regulus", "verify", proof, "--model",
                        path("bars.toml"), "--waypoints", way_});
  }
};

TEST_F(BarsOnWay, ContinueABound) {
  const auto bound = [this](const std::string& name, const Words& more) {
    Words words{"error", "--freedom", "psi", "--gap", "1e-2", "--certificate", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    return ask_bars("bound", words);
  };
  const CommandResult whole = bound("whole", {});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  for (const char* most : {"3", "20", "60"})
    EXPECT_EQ(bound("part", {"--checkpoint", path("saved"), "--max-boxes", most}).exit_code, 2);
  const CommandResult last = bound("part", {"--checkpoint", path("saved")});
  const json a = json::parse(last.output), b = json::parse(whole.output);
  for (const char* key : {"proved", "attained", "boxes"}) EXPECT_EQ(a.at(key), b.at(key)) << key;
  for (const char* end : {".psi.safe", ".psi.singular"}) {
    EXPECT_NE(file_contents(path("whole") + end), "") << end;
    EXPECT_TRUE(file_contents(path("part") + end) == file_contents(path("whole") + end)) << end;
  }
}

TEST_F(BarsOnWay, ContinueADatasheet) {
  const auto ends = [](const CommandResult& run) {
    const json sheet = json::parse(run.output);
    json found;
    for (const json& bound : sheet.at("bounds"))
      found.push_back({bound.at("quantity"), bound.at("proved"), bound.at("attained")});
    return found;
  };
  const CommandResult whole = ask_bars("datasheet", {"--gap", "0.05"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const Words kept{"--gap", "0.05", "--checkpoint", path("saved")};
  Words stopped = kept;
  stopped.insert(stopped.end(), {"--max-boxes", "20"});
  EXPECT_EQ(ask_bars("datasheet", stopped).exit_code, 2);
  EXPECT_EQ(ends(ask_bars("datasheet", kept)), ends(whole));
}

TEST_F(BarsOnWay, RefuseTheSearchOfAnotherQuestion) {
  const auto expect_refused = [this](const std::string& command, Words more) {
    more.insert(more.end(), {"--checkpoint", path("saved")});
    const CommandResult run = ask_bars(command, more);
    EXPECT_EQ(run.exit_code, 65) << run.output;
    EXPECT_THAT(run.errors, HasSubstr("another question"));
  };
  const Words bound{"error", "--gap", "0.1"}, load{"--load", "L"};
  Words begun = bound;
  begun.insert(begun.end(), {"--checkpoint", path("saved"), "--max-boxes", "5"});
  EXPECT_EQ(ask_bars("bound", begun).exit_code, 2);
  write_way("0\n-10\n-41\n");
  expect_refused("bound", bound);
  std::filesystem::remove(path("saved"));
  Words held = load;
  held.insert(held.end(), {"--checkpoint", path("saved"), "--max-boxes", "2"});
  EXPECT_EQ(ask_bars("check", held).exit_code, 2);
  write_bars("[-999, 1000]");
  expect_refused("check", load);
  write_bars("[-1000, 1000]");
  write_way("0\n-10\n-40\n");
  expect_refused("check", load);
}

TEST_F(BarsOnWay, ArePavedForALoad) {
  write_bars("[-2, 2]");
  write_way("0\n60\n-85\n10\n");
  const Words files{"--output",      path("lines"),   "--picture",
                    path("way.svg"), "--certificate", path("proof")};
  Words words{"--load", "L"};
  words.insert(words.end(), files.begin(), files.end());
  const CommandResult run = ask_bars("locate", words);
  EXPECT_EQ(run.exit_code, 1) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_EQ(report.at("verdict"), "infeasible");
  EXPECT_EQ(report.at("searched_alone"), 3);
  const CommandResult proof = verify_bars(path("proof"));
  EXPECT_EQ(proof.exit_code, 0) << proof.output;
  EXPECT_THAT(proof.errors, HasSubstr(" infeasible, "));
  // The stretches have no gaps, and their shares are those of the report.
  std::istringstream lines(file_contents(path("lines")));
  std::map<std::string, double> shares;
  double at = 0;
  std::string line;
  for (std::size_t k = 0; k < report.at("stretches"); ++k) {
    std::getline(lines, line);
    const json stretch = json::parse(line);
    const double begin = double(stretch.at("segments")[0]) - 1 + double(stretch.at("s")[0]);
    const double end = double(stretch.at("segments")[1]) - 1 + double(stretch.at("s")[1]);
    EXPECT_EQ(begin, at) << line;
    at = end;
    shares[stretch.at("kind")] += (end - begin) / 3;
  }
  EXPECT_EQ(at, 3);
  std::getline(lines, line);
  json summary = json::parse(line).at("summary");
  EXPECT_EQ(summary.at("share"), report.at("share"));
  for (const char* kind : {"feasible", "infeasible"}) {
    EXPECT_GT(shares[kind], 0.05) << kind;
    EXPECT_NEAR(shares[kind], report.at("share").at(kind), 1e-9) << kind;
  }
  EXPECT_THAT(file_contents(path("way.svg")), HasSubstr("bars, m, load L"));
  Words paged{"--load", "L", "--page", path("page.html")};
  EXPECT_EQ(ask_bars("locate", paged).exit_code, 1);
  EXPECT_THAT(file_contents(path("page.html")), HasSubstr("infeasible segment"));
}

/// The data name the segments.
TEST_F(BarsOnWay, HavePages) {
  for (const auto& [command, more] : std::vector<std::pair<std::string, Words>>{
           {"bound", {"error", "--gap", "0.1"}}, {"check", {"--load", "L"}}}) {
    Words words = more;
    words.insert(words.end(), {"--page", path("page.html")});
    const CommandResult run = ask_bars(command, words);
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    const std::string page = file_contents(path("page.html"));
    EXPECT_THAT(page, HasSubstr("piecewise")) << command;
    EXPECT_THAT(page, HasSubstr("\"segments\":2}")) << command;
  }
}

}  // namespace
}  // namespace regulus::detail::test
