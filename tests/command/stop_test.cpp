// SPDX-License-Identifier: GPL-3.0-or-later
// A time limit and an interrupt end every command with an answer, whatever the stage they meet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kStoppedCart = R"(regulus = 1
name = "cart"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["x", "y"], ["-y", "x"]]
[motion.work]
x = [0.5, 3.5]
y = [0.5, 2.5]
[actuators]
force = [-10, 10]
force_unit = "N"
[load.push]
force = [[-1, 1], [-1, 1]]
)";

struct StoppedQuestion {
  const char* name;
  std::vector<std::string> words;
};

void PrintTo(const StoppedQuestion& question, std::ostream* out) { *out << question.name; }

class Stop : public testing::TestWithParam<StoppedQuestion> {
 protected:
  Stop() {
    std::ofstream(folder_.path() / "cart.toml") << kStoppedCart;
    std::ofstream(folder_.path() / "way.csv") << "x,y\n1,1\n2,2\n3,1\n";
    setenv("XDG_CACHE_HOME", cache().c_str(), 1);
  }
  ~Stop() override { unsetenv("XDG_CACHE_HOME"); }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  [[nodiscard]] std::filesystem::path cache() const { return folder_.path() / "cache"; }

  /// The words of the command, for an empty cache.
  [[nodiscard]] std::vector<std::string> words() const {
    std::filesystem::remove_all(cache());
    std::vector<std::string> words{kCommand};
    for (const std::string& word : GetParam().words)
      words.push_back(word == "cart.toml" || word == "way.csv" ? (folder_.path() / word).string()
                                                               : word);
    return words;
  }

  /// True if a signal ended the process between its answer and its end.
  static bool was_after_the_answer(const CommandResult& result) {
    return result.exit_code == -1 && !result.output.empty() &&
           result.errors.find("terminate called") == std::string::npos;
  }

  /// `when`: for messages. A signal ends the process only in a stage that has nothing to report.
  static void expect_answer(const CommandResult& result, const std::string& when) {
    if (result.exit_code == 128 + SIGINT) return;
    if (was_after_the_answer(result)) return;
    EXPECT_THAT(result.exit_code, AnyOf(0, 1, 2)) << when << '\n' << result.errors;
    if (result.exit_code == 2) {
      EXPECT_THAT(result.output,
                  AnyOf(HasSubstr("POSSIBLE PROBLEM"), HasSubstr("possible-problem"),
                        HasSubstr("NOTHING KNOWN"), HasSubstr("SAFE UP TO"),
                        HasSubstr("NOT SAFE AT"), HasSubstr("AT LEAST"), HasSubstr("AT MOST"),
                        HasSubstr("BELOW"), HasSubstr("BETWEEN"), HasSubstr("quantity")))
          << when << '\n'
          << result.errors;
    }
  }

  TemporaryDirectory folder_;
};

TEST_P(Stop, AtATimeLimitGivesAnAnswer) {
  for (const char* limit : {"1e-6", "1e-5", "1e-4", "1e-3", "1e-2", "0.1"}) {
    std::vector<std::string> limited = words();
    limited.insert(limited.end(), {"--time-limit", limit});
    expect_answer(run_command(limited), limit);
  }
}

TEST_P(Stop, ByAnInterruptGivesAnAnswer) {
  for (const int milliseconds : {0, 3, 30}) {
    RunningCommand command(words());
    command.wait_for_handler(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(command.pid(), SIGINT);
    expect_answer(command.wait(), std::to_string(milliseconds) + " ms");
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfACommand, Stop,
    testing::Values(
        StoppedQuestion{"Check", {"check", kModels + "robot_1.toml", "wide_15"}},
        StoppedQuestion{"CheckOfASerialArm",
                        {"check", kModels + "puma_560_serial.toml", "dexterous"}},
        StoppedQuestion{"CheckOfLegs", {"check", kModels + "hexapod_6rus.toml", "work"}},
        StoppedQuestion{"CheckAlongWayPoints", {"check", "cart.toml", "--waypoints", "way.csv"}},
        StoppedQuestion{"CheckOfALoad", {"check", "cart.toml", "--load", "push"}},
        StoppedQuestion{"Locate", {"locate", kModels + "robot_1.toml", "wide_15"}},
        StoppedQuestion{"LocateOfALoad", {"locate", "cart.toml", "--load", "push"}},
        StoppedQuestion{"Margin",
                        {"margin", kModels + "robot_1.toml", "wide_15", "--scale", "1:3"}},
        StoppedQuestion{
            "MarginOfASerialArm",
            {"margin", kModels + "puma_560_serial.toml", "dexterous", "--scale", "1:2"}},
        StoppedQuestion{"DatasheetOfLegs", {"datasheet", kModels + "hexapod_6rus.toml", "work"}},
        StoppedQuestion{"MarginAlongWayPoints",
                        {"margin", "cart.toml", "--waypoints", "way.csv", "--tube", "0:1"}},
        StoppedQuestion{"Bound", {"bound", kModels + "orthoglide.toml", "cube", "sigma-min"}},
        StoppedQuestion{"BoundOfTheConditionNumber",
                        {"bound", kModels + "robot_1.toml", "wide_15", "condition", "--norm", "2"}},
        StoppedQuestion{"Datasheet", {"datasheet", kModels + "robot_1.toml", "wide_15"}}),
    [](const testing::TestParamInfo<StoppedQuestion>& question) { return question.param.name; });

}  // namespace
}  // namespace regulus::detail::test
