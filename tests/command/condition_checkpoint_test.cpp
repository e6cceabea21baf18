// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus bound condition --norm 2 --checkpoint`, stopped, killed and damaged.
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
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"
#include "tests/support/turn_model.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ConditionCheckpointTest : public testing::Test {
 protected:
  ConditionCheckpointTest() { std::ofstream(model_) << kTurn; }

  [[nodiscard]] std::vector<std::string> words(std::vector<std::string> more) const {
    std::vector<std::string> all{kCommand, "bound",        model_, "condition", "--norm",
                                 "2",      "--time-limit", "600",  "--json",    "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] CommandResult ask(std::vector<std::string> more) const {
    return run_command(words(std::move(more)));
  }
  /// Returns the report without its times and options.
  [[nodiscard]] static json facts(const CommandResult& r) {
    const json report = json::parse(r.output);
    json facts;
    for (const char* key : {"result", "attained", "proved", "boxes", "gap"})
      facts[key] = report.at(key);
    facts["place"] = report.at("components")[0].at("place");
    return facts;
  }
  [[nodiscard]] bool is_saved() const {
    return file_contents(file_).find("\"steps\"") != std::string::npos;
  }
  void wait_until_saved() const {
    for (int i = 0; !is_saved() && i < 20000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "turn.toml", file_ = folder_.path() / "state";
};

TEST_F(ConditionCheckpointTest, LeadsToTheSameReport) {
  const CommandResult whole = ask({"--gap", "0.03", "--threads", "1"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const char* threads = "1";
  for (const char* stop : {"100", "1000", "3000"}) {
    EXPECT_EQ(
        ask({"--gap", "0.03", "--threads", threads, "--max-boxes", stop, "--checkpoint", file_})
            .exit_code,
        2);
    threads = "2";
  }
  const CommandResult continued = ask({"--gap", "0.03", "--threads", "2", "--checkpoint", file_});
  EXPECT_EQ(facts(continued), facts(whole));
  EXPECT_EQ(facts(ask({"--gap", "0.03", "--checkpoint", file_})), facts(whole));
  EXPECT_EQ(json::parse(ask({"--limit", "5.1", "--checkpoint", file_}).output).at("result"),
            "WITHIN");
  EXPECT_EQ(ask({"--limit", "4.9", "--checkpoint", file_}).exit_code, 1);
}

/// A kill may come before the search begins, while it is saved, or between.
TEST_F(ConditionCheckpointTest, SurvivesKills) {
  const std::vector<std::string> question{"--gap", "4e-3", "--threads", "1"};
  const CommandResult whole = ask(question);
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  std::vector<std::string> saved = question;
  saved.insert(saved.end(), {"--checkpoint", file_});
  std::mt19937 random(1);
  int continued = 0;
  for (int kill = 0; kill < trials(3, 6); ++kill) {
    continued += is_saved() ? 1 : 0;
    RunningCommand run(words(saved));
    wait_until_saved();
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 400));
    ::kill(run.pid(), SIGKILL);
    static_cast<void>(run.wait());
  }
  EXPECT_GT(continued, 0);
  EXPECT_EQ(facts(ask(saved)), facts(whole));
}

TEST_F(ConditionCheckpointTest, IsSavedAtAnInterrupt) {
  const std::vector<std::string> question{"--gap", "1e-4", "--threads", "1", "--checkpoint", file_};
  RunningCommand run(words(question));
  wait_until_saved();
  ::kill(run.pid(), SIGINT);
  const CommandResult interrupted = run.wait();
  EXPECT_EQ(interrupted.exit_code, 2) << interrupted.errors;
  const json report = json::parse(interrupted.output);
  const json state = json::parse(file_contents(file_)).at("known").at("tree");
  EXPECT_FALSE(state.at("open").get<std::string>().empty());
  std::vector<std::string> stopped = question;
  stopped.insert(stopped.end(), {"--max-boxes", "1"});
  EXPECT_EQ(json::parse(ask(stopped).output).at("proved"), report.at("proved"));
}

TEST_F(ConditionCheckpointTest, OfAnotherQuestionIsRefused) {
  ASSERT_EQ(ask({"--gap", "0.3", "--checkpoint", file_}).exit_code, 0);
  const std::string before = file_contents(file_);
  const CommandResult other = ask({"--range", "x=0:2", "--gap", "0.3", "--checkpoint", file_});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("it is about another question"));
  EXPECT_EQ(regulus({"bound", model_, "sigma-max", "--checkpoint", file_}).exit_code, 65);
  EXPECT_EQ(file_contents(file_), before);
}

TEST_F(ConditionCheckpointTest, IfDamagedIsRefusedOrRight) {
  const std::vector<std::string> question{"--gap", "0.2", "--threads", "1", "--checkpoint", file_};
  std::vector<std::string> start = question;
  start.insert(start.end(), {"--max-boxes", "100"});
  ASSERT_EQ(ask(start).exit_code, 2);
  const std::string saved = file_contents(file_);
  const std::size_t state = saved.find("\"tree\"");
  ASSERT_NE(state, std::string::npos);
  const std::vector<std::string> splices{" ",        "-",    "=",  "7",  "0:1 ",
                                         "=0x0p+0 ", "null", "{}", "\"", "1e9"};
  int refused = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::ofstream(file_) << saved.substr(0, state)
                         << Damage(seed, splices).done_to(saved.substr(state));
    const CommandResult r = ask(question);
    if (r.exit_code == 65) {
      EXPECT_THAT(r.errors, HasSubstr("the bracket cannot continue from this file")) << seed;
      ++refused;
      continue;
    }
    ASSERT_EQ(r.exit_code, 0) << seed << r.errors;
    const json report = json::parse(r.output);
    EXPECT_GE(report.at("proved"), 5) << seed;
    EXPECT_LE(report.at("attained"), 5) << seed;
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace regulus::detail::test
