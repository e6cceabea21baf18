// SPDX-License-Identifier: GPL-3.0-or-later
// The compiler beside a search: a process that can be ended like any other.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <sstream>
#include <thread>

#include "support/cached_command.hpp"

namespace regulus::test {
namespace {

/// The field of /proc/PID/status; empty when there is no such process any more.
std::string status(const std::string& process, const std::string& field) {
  std::istringstream lines(file_contents("/proc/" + process + "/status"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(field + ":\t")) return line.substr(field.size() + 2);
  return "";
}

std::optional<std::string> child_of(pid_t parent) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") == std::string::npos &&
        status(name, "PPid") == std::to_string(parent))
      return name;
  }
  return std::nullopt;
}

bool has_ended(const std::string& process) {
  const std::string state = status(process, "State");
  return state.empty() || state.starts_with('Z');
}

/// Until it is true, or the search is over, which would take minutes.
template <class Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 20000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(ACompilerInTheBackground, TakesTheSignalsThatEndAProcess) {
  const CachedCommand cached;
  RunningCommand run({REGULUS_BINARY_DIR "/bin/regulus", "check",
                      REGULUS_SOURCE_DIR "/models/robot_1.toml", "table6_15_15", "--tolerance",
                      "base,platform=0.14", "--engine", "auto"});
  std::optional<std::string> child;
  EXPECT_TRUE(comes_true([&] { return (child = child_of(run.pid())).has_value(); }));
  if (child) {
    // The compiler may be done before it is looked at: then there is nothing left to end.
    EXPECT_TRUE(comes_true([&] {
      const std::string blocked = status(*child, "SigBlk");
      return has_ended(*child) || blocked.find_first_not_of('0') == std::string::npos;
    }));
    ::kill(std::stoi(*child), SIGTERM);
    EXPECT_TRUE(comes_true([&] { return has_ended(*child); }));
  }
  EXPECT_EQ(::kill(run.pid(), 0), 0);
  ::kill(run.pid(), SIGKILL);
  EXPECT_EQ(run.wait().exit_code, -1);
}

}  // namespace
}  // namespace regulus::test
