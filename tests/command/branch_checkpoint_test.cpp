// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of bounds and loads over a branch: stopped, killed, damaged, and of another
// question.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "tests/support/bars.hpp"
#include "tests/support/command.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class BranchCheckpoint : public testing::Test {
 protected:
  BranchCheckpoint() { write(with_force("[-4.6, 2.1]")); }

  static std::string with_force(const std::string& limits) { return bars("0.002", limits); }

  void write(const std::string& text) const { std::ofstream(model_) << text; }
  [[nodiscard]] Words words(const std::string& command, Words more) const {
    Words all{REGULUS_BINARY_DIR "/bin/regulus", command, model_, "m"};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--time-limit", "600", "--json", "--quiet"});
    return all;
  }
  [[nodiscard]] CommandResult ask(const std::string& command, Words more) const {
    return run_command(words(command, std::move(more)));
  }
  /// Returns the report without its times, options and files.
  [[nodiscard]] static json facts(const CommandResult& r) {
    json report = json::parse(r.output);
    const std::function<void(json&)> strip = [&](json& value) {
      if (!value.is_structured()) return;
      if (value.is_object())
        for (const char* key : {"seconds", "time", "question", "stages", "checkpoint", "command"})
          value.erase(key);
      for (json& part : value) strip(part);
    };
    strip(report);
    return report;
  }
  [[nodiscard]] bool is_saved() const {
    return file_contents(file_).find("\"steps\"") != std::string::npos;
  }
  void wait_until_saved() const {
    for (int i = 0; !is_saved() && i < 20000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void expect_same_after_stops(const std::string& command, const Words& question,
                               const Words& stops) const {
    const CommandResult whole = ask(command, question);
    ASSERT_LE(whole.exit_code, 1) << whole.errors;
    Words kept = question;
    kept.insert(kept.end(), {"--checkpoint", file_});
    for (const std::string& stop : stops) {
      Words stopped = kept;
      stopped.insert(stopped.end(), {"--max-boxes", stop});
      EXPECT_EQ(ask(command, stopped).exit_code, 2) << stop;
    }
    EXPECT_EQ(facts(ask(command, kept)), facts(whole));
  }

  /// A kill may come before the search begins, while it is saved, or between.
  void expect_survival(const Words& question) const {
    std::filesystem::remove(file_);
    const CommandResult whole = ask("bound", question);
    ASSERT_EQ(whole.exit_code, 0) << whole.errors;
    Words saved = question;
    saved.insert(saved.end(), {"--checkpoint", file_});
    std::mt19937 random(1);
    int continued = 0;
    for (int kill = 0; kill < trials(2, 12); ++kill) {
      continued += is_saved() ? 1 : 0;
      RunningCommand run(words("bound", saved));
      wait_until_saved();
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
      ::kill(run.pid(), SIGKILL);
      static_cast<void>(run.wait());
    }
    EXPECT_GT(continued, 0);
    EXPECT_EQ(facts(ask("bound", saved)), facts(whole));
  }

  const TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "bars.toml", file_ = folder_.path() / "state";
};

TEST_F(BranchCheckpoint, OfABoundLeadsToTheSameReport) {
  for (const char* quantity : {"condition", "error", "force"}) {
    std::filesystem::remove(file_);
    expect_same_after_stops("bound", {quantity, "--gap", "4e-3", "--threads", "1"},
                            {"3", "40", "100", "400"});
  }
}

TEST_F(BranchCheckpoint, OfSingularValuesLeadsToTheSameReport) {
  for (const Words& quantity : {Words{"condition", "--norm", "2"}, Words{"sigma-max"}}) {
    std::filesystem::remove(file_);
    Words question = quantity;
    question.insert(question.end(), {"--gap", "1e-5", "--threads", "1"});
    expect_same_after_stops("bound", question, {"3", "40", "100"});
  }
}

/// Two branches are kept, with and without the copy of the mechanism.
TEST_F(BranchCheckpoint, OfAFiniteErrorLeadsToTheSameReport) {
  expect_same_after_stops("bound", {"error", "--finite", "--gap", "1e-2", "--threads", "1"},
                          {"3", "40", "100"});
}

TEST_F(BranchCheckpoint, OfALimitLeadsToTheSameReport) {
  const CommandResult bracket = ask("bound", {"condition", "--gap", "1e-3"});
  const double proved = json::parse(bracket.output).at("proved");
  for (const double part : {0.999, 1.001}) {
    std::filesystem::remove(file_);
    expect_same_after_stops(
        "bound", {"condition", "--limit", std::to_string(proved * part), "--threads", "1"}, {"3"});
  }
}

TEST_F(BranchCheckpoint, OfALoadLeadsToTheSameReport) {
  expect_same_after_stops("check", {"--load", "L", "--threads", "1"}, {"2"});
}

TEST_F(BranchCheckpoint, OfAPavedLoadLeadsToTheSameReport) {
  write(with_force("[-3, 2]"));
  const std::string lines = folder_.path() / "lines";
  const Words question{"--load", "L", "--resolution", "1/512", "--threads", "1", "--output", lines};
  // The last line is the summary, with its times.
  const auto boxes = [&] {
    const std::string text = file_contents(lines);
    return text.substr(0, text.rfind('\n', text.size() - 2));
  };
  ASSERT_LE(ask("locate", question).exit_code, 2);
  const std::string whole = boxes();
  Words kept = question;
  kept.insert(kept.end(), {"--checkpoint", file_});
  for (const char* stop : {"2", "20", "40"}) {
    Words stopped = kept;
    stopped.insert(stopped.end(), {"--max-boxes", stop});
    static_cast<void>(ask("locate", stopped));
  }
  static_cast<void>(ask("locate", kept));
  EXPECT_EQ(boxes(), whole);
}

TEST_F(BranchCheckpoint, OfADatasheetKeepsAllQuantities) {
  const Words question{"--gap", "0.01", "--threads", "1"};
  const auto ends = [](const CommandResult& r) {
    const json sheet = json::parse(r.output);
    json found;
    for (const json& bound : sheet.at("bounds"))
      found.push_back({bound.at("quantity"), bound.at("proved"), bound.at("attained")});
    return found;
  };
  const CommandResult whole = ask("datasheet", question);
  ASSERT_EQ(whole.exit_code, 0) << whole.errors << whole.output;
  Words kept = question;
  kept.insert(kept.end(), {"--checkpoint", file_});
  Words stopped = kept;
  stopped.insert(stopped.end(), {"--max-boxes", "30"});
  EXPECT_EQ(ask("datasheet", stopped).exit_code, 2);
  EXPECT_EQ(ends(ask("datasheet", kept)), ends(whole));
}

TEST_F(BranchCheckpoint, SurvivesKills) {
  expect_survival({"error", "--gap", "1e-3", "--threads", "1"});
  expect_survival({"condition", "--norm", "2", "--gap", "1e-6", "--threads", "1"});
}

/// The file names the question: its quantity, its motion, and the text of its model.
TEST_F(BranchCheckpoint, OfAnotherQuestionIsRefused) {
  const auto expect_refused = [this](const std::string& command, Words more) {
    more.insert(more.end(), {"--checkpoint", file_});
    const std::string before = file_contents(file_);
    const CommandResult other = ask(command, more);
    EXPECT_EQ(other.exit_code, 65) << other.output;
    EXPECT_THAT(other.errors, HasSubstr("it is about another question"));
    EXPECT_EQ(file_contents(file_), before);
  };
  ASSERT_EQ(ask("bound", {"error", "--gap", "0.3", "--checkpoint", file_}).exit_code, 0);
  expect_refused("bound", {"speed", "--gap", "0.3"});
  expect_refused("bound", {"error", "--freedom", "phi", "--gap", "0.3"});
  expect_refused("bound", {"error", "--gap", "0.3", "--range", "theta=-1:1"});
  expect_refused("check", {"--load", "L"});
  std::string text = with_force("[-4.6, 2.1]");
  write(text.replace(text.find("0.45"), 4, "0.46"));
  expect_refused("bound", {"error", "--gap", "0.3"});
}

TEST_F(BranchCheckpoint, IfDamagedIsRefusedOrRight) {
  const Words question{"condition", "--gap", "0.05", "--threads", "1"};
  const json whole = json::parse(ask("bound", question).output);
  const double attained = whole.at("attained"), proved = whole.at("proved");
  Words kept = question;
  kept.insert(kept.end(), {"--checkpoint", file_});
  Words start = kept;
  start.insert(start.end(), {"--max-boxes", "20"});
  ASSERT_EQ(ask("bound", start).exit_code, 2);
  const std::string saved = file_contents(file_);
  const std::size_t state = saved.find("\"known\"");
  ASSERT_NE(state, std::string::npos);
  const Words splices{" ", "-", "=", "7", "0:1 ", "=0x0p+0 ", "null", "{}", "\"", "1e9", "0:0 "};
  int refused = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::ofstream(file_) << saved.substr(0, state)
                         << Damage(seed, splices).done_to(saved.substr(state));
    const CommandResult r = ask("bound", kept);
    if (r.exit_code == 65) {
      EXPECT_THAT(r.errors, HasSubstr("the bracket cannot continue from this file")) << seed;
      ++refused;
      continue;
    }
    ASSERT_LE(r.exit_code, 2) << seed << r.errors;
    const json report = json::parse(r.output);
    const json &upper = report.at("proved"), &lower = report.at("attained");
    EXPECT_TRUE(upper.is_null() || upper >= attained) << seed;
    EXPECT_TRUE(lower.is_null() || lower <= proved) << seed;
  }
  EXPECT_GT(refused, 5);
}

}  // namespace
}  // namespace regulus::detail::test
