// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of solve, at one place and at many: stopped, interrupted, killed, damaged,
// forged, and of another question.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/command/forged_checkpoints.hpp"
#include "tests/support/command.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

std::string library_model(const std::string& name) {
  return REGULUS_SOURCE_DIR "/models/" + name + ".toml";
}

const Words kRobot = {library_model("robot_1"),
                      "--at",
                      "x=1",
                      "--at",
                      "y=2",
                      "--at",
                      "z=47",
                      "--at",
                      "psi=0.1",
                      "--at",
                      "theta=0.12",
                      "--at",
                      "phi=0.05"};
const Words kButterfly = {library_model("double_butterfly"), "--at", "theta=67.38"};
const Words kArm = {library_model("puma_560_serial"),
                    "--at",
                    "q1=0.3",
                    "--at",
                    "q2=0.4",
                    "--at",
                    "q3=-0.7",
                    "--at",
                    "q4=0.3",
                    "--at",
                    "q5=0.9",
                    "--at",
                    "q6=-1.4"};

class SolveCheckpoint : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

  /// `name`: of the files beside the report.
  [[nodiscard]] Words words(const Words& question, const std::string& name, Words more) const {
    Words all{REGULUS_BINARY_DIR "/bin/regulus", "solve"};
    all.insert(all.end(), question.begin(), question.end());
    all.insert(all.end(), {"--json", "--time-limit", "600", "--certificate", path(name)});
    if (std::ranges::find(question, "--waypoints") != question.end())
      all.insert(all.end(), {"--output", path(name + ".jsonl")});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] CommandResult solve(const Words& question, const std::string& name,
                                    const Words& more = {}) const {
    return run_command(words(question, name, more));
  }
  [[nodiscard]] Words kept(Words more = {}) const {
    more.insert(more.end(), {"--checkpoint", path("saved"), "--checkpoint-every", "0"});
    return more;
  }

  /// Returns what may not depend on stops: the report, the lines and the proof, without times, options
  /// and names of files.
  [[nodiscard]] std::string answer_of(const CommandResult& run, const std::string& name) const {
    const std::function<void(json&)> strip = [&](json& value) {
      if (!value.is_structured()) return;
      if (value.is_object())
        for (const char* key : {"seconds", "options", "threads", "certificate", "file"})
          value.erase(key);
      for (json& part : value) strip(part);
    };
    json report = json::parse(run.output);
    strip(report);
    return report.dump(1) + file_contents(path(name + ".jsonl")) + file_contents(path(name));
  }
  [[nodiscard]] json saved() const {
    const std::string text = file_contents(path("saved"));
    return text.empty() ? json() : json::parse(text);
  }
  /// Returns the file of a run that is stopped after so many boxes at a place.
  [[nodiscard]] json saved_after(const Words& question, const std::string& boxes) const {
    std::filesystem::remove(path("saved"));
    EXPECT_EQ(solve(question, "stopped", kept({"--max-boxes", boxes})).exit_code, 2);
    return saved();
  }

  void expect_same_after_stops(const Words& question, const Words& stops) const {
    const CommandResult whole = solve(question, "whole");
    ASSERT_EQ(whole.exit_code, 0) << whole.errors;
    for (const std::string& stop : stops) {
      EXPECT_EQ(solve(question, "many", kept({"--max-boxes", stop})).exit_code, 2) << stop;
      EXPECT_TRUE(has_tree(saved())) << stop;
    }
    const CommandResult last = solve(question, "many", kept());
    EXPECT_EQ(last.exit_code, 0) << last.errors;
    EXPECT_EQ(answer_of(last, "many"), answer_of(whole, "whole"));
    EXPECT_FALSE(std::filesystem::exists(path("saved")));
  }

  /// A table of lengths, the last of them without a pose.
  [[nodiscard]] Words table(int places) const {
    std::ofstream file(path("lengths.csv"));
    file << "t [s], rho_1, rho_2, rho_3\n";
    for (int k = 0; k < places; ++k) file << k << ", 14.98, " << 15.3 + 0.001 * k << ", 12\n";
    file << places << ", 100, 1, 1\n";
    return {library_model("rpr_6"), "--waypoints", path("lengths.csv")};
  }
  /// Runs, and sends the signal when as many searches are in the file. On a busy machine the run may end before the
  /// signal comes, and leave no file: it is begun again.
  [[nodiscard]] CommandResult stopped_by(int signal, const Words& question,
                                         std::size_t searches) const {
    constexpr int kMostRuns = 10;
    for (int number = 1;; ++number) {
      CommandResult result = signalled(signal, question, searches);
      if (std::filesystem::exists(path("saved")) || number == kMostRuns) return result;
    }
  }
  [[nodiscard]] CommandResult signalled(int signal, const Words& question,
                                        std::size_t searches) const {
    RunningCommand run(words(question, "many", kept()));
    bool has_begun = std::filesystem::exists(path("saved"));
    for (int i = 0; i < 20000; ++i) {
      const bool has_file = std::filesystem::exists(path("saved"));
      if (has_begun && !has_file) break;  // it has ended
      has_begun = has_begun || has_file;
      const json file = json::parse(file_contents(path("saved")), nullptr, false);
      if (file.is_object() && file.at("known").size() >= searches) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(run.pid(), signal);
    return run.wait();
  }

  const TemporaryDirectory folder_;
};

TEST_F(SolveCheckpoint, AtOnePlaceLeadsToTheSameAnswer) {
  expect_same_after_stops(kButterfly, {"20", "100", "300", "400"});
  expect_same_after_stops(kArm, {"10", "40", "80"});
  expect_same_after_stops({library_model("rpr_6")}, {"30", "90"});
}

/// Four searches, one after the other; the errors of a platform need more of them.
TEST_F(SolveCheckpoint, OfAPlatformInSpaceLeadsToTheSameAnswer) {
  expect_same_after_stops(kRobot, {"300", "1700", "2500", "5000"});
  Words errors = kRobot;
  errors.insert(errors.end(), {"--tolerance", "base=1e-4"});
  expect_same_after_stops(errors, {"1000", "5890"});
}

TEST_F(SolveCheckpoint, OfATableLeadsToTheSameAnswer) {
  const Words question = table(12);
  const CommandResult whole = solve(question, "whole");
  ASSERT_EQ(whole.exit_code, 1) << whole.errors;
  EXPECT_EQ(solve(question, "many", kept({"--max-boxes", "60"})).exit_code, 2);
  const CommandResult interrupted = stopped_by(SIGINT, question, 13);
  const CommandResult last = solve(question, "many", kept());
  EXPECT_EQ(answer_of(last, "many"), answer_of(whole, "whole")) << interrupted.errors;
  EXPECT_FALSE(std::filesystem::exists(path("saved")));
}

TEST_F(SolveCheckpoint, OfATableSurvivesSignals) {
  const Words question = table(40);
  const CommandResult whole = solve(question, "whole");
  ASSERT_EQ(whole.exit_code, 1) << whole.errors;
  for (const auto& [signal, searches] : {std::pair<int, std::size_t>{SIGKILL, 5}, {SIGINT, 15}}) {
    const CommandResult stopped = stopped_by(signal, question, searches);
    EXPECT_GE(saved().at("known").size(), searches);
    if (signal == SIGKILL) continue;
    EXPECT_EQ(stopped.exit_code, 2) << stopped.errors;
    EXPECT_GT(json::parse(stopped.output).at("places_left"), 0);
  }
  EXPECT_EQ(answer_of(solve(question, "many", kept()), "many"), answer_of(whole, "whole"));
}

TEST_F(SolveCheckpoint, ContinuesWithMoreThreadsAndSaysSo) {
  const CommandResult whole = solve(kRobot, "whole", {"--threads", "1"});
  static_cast<void>(saved_after(kRobot, "3000"));
  Words all = words(kRobot, "many", kept({"--threads", "4"}));
  std::erase(all, "--json");
  const CommandResult last = run_command(all);
  EXPECT_EQ(last.output, "COMPLETE: 12 poses\n");
  EXPECT_THAT(last.errors, HasSubstr("continued from " + path("saved")));
  EXPECT_EQ(file_contents(path("many")), file_contents(path("whole"))) << whole.errors;
}

/// Whatever is done to the file, no list is whole that is not.
TEST_F(SolveCheckpoint, WithFalseClaimsProvesNothing) {
  const auto expect_truth = [this](const json& file, const std::string& what) {
    std::ofstream(path("saved")) << file.dump();
    const CommandResult run = solve(kButterfly, "many", kept());
    if (run.exit_code == 65) {
      EXPECT_THAT(run.errors, HasSubstr("cannot continue from this file")) << what;
      return;
    }
    ASSERT_LE(run.exit_code, 2) << what << run.errors;
    const json report = json::parse(run.output);
    EXPECT_NE(report.at("verdict"), "none") << what;
    if (report.at("verdict") != "complete") return;
    EXPECT_EQ(report.at("solutions").size(), 6U) << what;
  };
  for (const char* boxes : {"40", "200", "430"}) {
    const json genuine = saved_after(kButterfly, boxes);
    ASSERT_TRUE(has_tree(genuine));
    for (const std::string claim : {"-", "=0x0p+0"}) {
      expect_truth(with_leaves_for_open(genuine, claim), "open boxes claim " + claim);
      expect_truth(with_claims(genuine, claim), "leaves claim " + claim);
      expect_truth(with_claims(with_leaves_for_open(genuine, "-"), claim), "all claim " + claim);
    }
    expect_truth(without_open(genuine), "an open box is missing");
    expect_truth(without_leaf(genuine), "a leaf is missing");
    for (const std::string cut : {"@0x0p+0", "@-0x1p+9", "@0x1p-3", ""}) {
      json moved = with_claims(with_leaves_for_open(genuine, "-"), "-");
      for_each_tree(moved, [&cut](json& tree) {
        std::vector<std::string> steps = words_of(tree["steps"]);
        for (std::string& word : steps)
          if (word.find('@') != std::string::npos) word = word.substr(0, word.find('@')) + cut;
        tree["steps"] = text_from(steps);
      });
      expect_truth(moved, "cuts are at " + cut);
    }
    json later = genuine;
    for_each_tree(later, [](json& tree) { tree["own"] = {0}; });
    expect_truth(later, "the search should end");
  }
}

/// The searches of places, as if they were those of other ones, and of a place without solutions.
TEST_F(SolveCheckpoint, OfOtherPlacesProvesNothing) {
  constexpr std::size_t kShifts = 3;
  const Words question = table(60);  // more than are solved before the signal is sent
  const CommandResult whole = solve(question, "whole");
  json file;
  for (int attempt = 0; attempt < 5 && !file.is_object(); ++attempt) {
    static_cast<void>(stopped_by(SIGKILL, question, 4));
    file = saved();
  }
  ASSERT_TRUE(file.is_object()) << "each run ended before it was stopped";
  json& known = file.at("known");
  const std::vector<json> trees(known.begin(), known.end());
  for (std::size_t shift = 1; shift <= std::min(kShifts, trees.size() - 1); ++shift) {
    std::size_t at = shift;
    for (json& tree : known) tree = trees[at++ % trees.size()];
    std::ofstream(path("saved")) << file.dump();
    const CommandResult run = solve(question, "many", kept());
    if (run.exit_code == 65)
      EXPECT_THAT(run.errors, HasSubstr("cannot continue from this file"));
    else
      EXPECT_EQ(answer_of(run, "many"), answer_of(whole, "whole")) << shift;
  }
}

TEST_F(SolveCheckpoint, ThatIsDamagedIsRefusedOrHasNoEffect) {
  const CommandResult whole = solve(kButterfly, "whole");
  const std::string genuine = saved_after(kButterfly, "300").dump();
  const std::vector<std::string> splices = {"\"", "{", "0:1 ", "@", "-", "=0x1p+0", "1", ":"};
  for (int trial = 0; trial < trials(12, 200); ++trial) {
    std::ofstream(path("saved")) << Damage(unsigned(trial), splices).done_to(genuine);
    const CommandResult run = solve(kButterfly, "many", kept());
    if (run.exit_code == 65) {
      EXPECT_THAT(run.errors, HasSubstr("cannot continue from this file")) << trial;
      continue;
    }
    EXPECT_EQ(run.exit_code, 0) << trial << run.errors;
    EXPECT_EQ(json::parse(run.output).at("solutions"), json::parse(whole.output).at("solutions"));
  }
}

TEST_F(SolveCheckpoint, OfAnotherQuestionIsRefused) {
  const json genuine = saved_after(kButterfly, "100");
  const auto expect_refused = [this](const Words& question) {
    const std::string before = file_contents(path("saved"));
    const CommandResult other = solve(question, "many", kept());
    EXPECT_EQ(other.exit_code, 65) << other.output;
    EXPECT_THAT(other.errors, HasSubstr("it is about another question"));
    EXPECT_EQ(file_contents(path("saved")), before);
  };
  expect_refused({library_model("double_butterfly"), "--at", "theta=67.39"});
  expect_refused(table(2));
  std::filesystem::remove(path("saved"));
  static_cast<void>(stopped_by(SIGKILL, table(30), 3));
  ASSERT_TRUE(saved().is_object());
  expect_refused(table(31));
  expect_refused(kButterfly);
}

/// The file system is full: the answer is told, and that it cannot be continued.
TEST_F(SolveCheckpoint, ThatCannotBeWrittenCostsNoAnswer) {
  static_cast<void>(saved_after(kButterfly, "100"));
  Words all = words(kButterfly, "many", {"--checkpoint", path("saved"), "--max-boxes", "200"});
  std::string shell = "ulimit -f 0; exec";
  for (const std::string& word : all)
    if (word != "--certificate" && word != path("many")) shell += " '" + word + "'";
  const CommandResult run = run_command({"/bin/sh", "-c", shell});
  EXPECT_THAT(run.output, HasSubstr("\"verdict\": \"incomplete\""));
  EXPECT_THAT(run.errors, HasSubstr("the checkpoint " + path("saved") + " cannot "));
  EXPECT_EQ(run.exit_code, 74);
}

}  // namespace
}  // namespace regulus::detail::test
