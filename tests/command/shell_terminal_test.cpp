// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the shell as a person at a terminal uses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// Plays a person at a terminal.
class Terminal {
 public:
  /// `kind`: the value of TERM. `more`: another variable of the environment, NAME=VALUE.
  explicit Terminal(const std::string& home, const char* kind = "dumb", std::string more = "A=") {
    pid_ = forkpty(&end_, nullptr, nullptr, nullptr);
    if (pid_ != 0) return;
    setenv("HOME", home.c_str(), 1);
    unsetenv("XDG_STATE_HOME");
    unsetenv("NO_COLOR");
    setenv("TERM", kind, 1);
    putenv(more.data());
    execl(kCommand.c_str(), "regulus", "shell", nullptr);
    _exit(127);
  }
  ~Terminal() {
    close(end_);
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }

  void type(const std::string& text) {
    ASSERT_EQ(write(end_, text.data(), text.size()), ssize_t(text.size()));
  }
  /// Returns true if the text appears after the last one found; gives up after a minute of silence.
  bool shows(const std::string& text) {
    for (;;) {
      if (const std::size_t at = seen_.find(text); at != std::string::npos) {
        seen_.erase(0, at + text.size());
        return true;
      }
      pollfd wait{end_, POLLIN, 0};
      if (poll(&wait, 1, 60000) <= 0) return false;
      char part[4096];
      const ssize_t n = ::read(end_, part, sizeof part);
      if (n <= 0) return false;
      seen_.append(part, std::size_t(n));
    }
  }
  /// Returns the exit code of a shell that is ending; -1 if it has not ended after a minute.
  int exit_code() { return exit_code_after(""); }
  /// Types the end of the input and returns the exit code. It types more than once, because the
  /// terminal is not yet raw just after the prompt.
  int exit_code_at_end_of_file() { return exit_code_after("\x04"); }
  [[nodiscard]] std::string seen() const { return seen_; }

 private:
  int exit_code_after(const std::string& typed) {
    for (int tenth = 0; tenth < 600; ++tenth) {
      [[maybe_unused]] const ssize_t written = write(end_, typed.data(), typed.size());
      int status = -1;
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return -1;
  }

  int end_ = -1;
  pid_t pid_ = -1;
  std::string seen_;
};

TEST(ShellAtATerminal, AnErrorDoesNotEndItAndQuitDoes) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> ")) << terminal.seen();
  terminal.type("load /nowhere.toml\n");
  ASSERT_TRUE(terminal.shows("no such file")) << terminal.seen();
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("quit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

/// A terminal that does not say how wide it is has 80 columns.
TEST(ShellAtATerminal, ReportsFitIt) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("load robot_1\nmotion T1\ncheck --tolerance base=0.01\n");
  EXPECT_TRUE(terminal.shows(
      "\r\nmeaning    the platform cannot give way at any pose of this motion while its\r\n"
      "           legs hold, whatever the uncertain quantities are within their\r\n"
      "           tolerances\r\n"))
      << terminal.seen();
}

TEST(ShellAtATerminal, LocateDrawsAMap) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("load " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml\n");
  ASSERT_TRUE(terminal.shows("regulus planar_3rpr> ")) << terminal.seen();
  terminal.type(
      "locate crossing --range x=-36:20 --range y=-16:36 --range phi=25*deg "
      "--resolution 1/16\n");
  ASSERT_TRUE(terminal.shows(
      "\r\nmap        x to the right, y upward: # singular, ? undecided, . free\r\n"))
      << terminal.seen();
  ASSERT_TRUE(terminal.shows("  36 ..............#."));
  ASSERT_TRUE(terminal.shows("  -36 "));
  ASSERT_TRUE(terminal.shows("\r\nSINGULARITY\r\n"));
}

TEST(ShellAtATerminal, GreetsWithLinesThatWork) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  for (const char* line : {"  load robot_1 ", "  motion wide_15 ", "  check "})
    ASSERT_TRUE(terminal.shows(line)) << terminal.seen();
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("load " REGULUS_SOURCE_DIR "/models/robot_1.toml\n");
  ASSERT_TRUE(terminal.shows("regulus robot_1> ")) << terminal.seen();
  terminal.type("motion wide_15\ncheck\n");
  ASSERT_TRUE(terminal.shows("regulus robot_1 wide_15> "));
  ASSERT_TRUE(terminal.shows("\r\nNO SINGULARITY\r\n")) << terminal.seen();
  terminal.type("exit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

TEST(ShellAtATerminal, HasColoursUnlessTheyAreForbidden) {
  const TemporaryDirectory home;
  const char* const lines = "load " REGULUS_SOURCE_DIR
                            "/models/planar_3rpr.toml\nmotion regular\n"
                            "check\nmotions\nquit\n";
  Terminal terminal(home.path().string(), "xterm");
  ASSERT_TRUE(terminal.shows("\033[1mregulus>\033[0m ")) << terminal.seen();
  terminal.type(lines);
  ASSERT_TRUE(terminal.shows("\033[1;32mNO SINGULARITY\033[0m")) << terminal.seen();
  EXPECT_EQ(terminal.exit_code(), 0);
  Terminal plain(home.path().string(), "xterm", "NO_COLOR=1");
  plain.type(lines);
  ASSERT_TRUE(plain.shows("\r\nNO SINGULARITY\r\n")) << plain.seen();
  EXPECT_EQ(plain.exit_code(), 0);
}

TEST(ShellAtATerminal, AnInterruptEndsTheSearchAndNotTheSession) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("load " REGULUS_SOURCE_DIR "/models/robot_2.toml\n");
  ASSERT_TRUE(terminal.shows("motions")) << terminal.seen();
  // Without its strongest tests this takes far longer than the test.
  terminal.type("motion table5_30\nset method reg\nset engine interpreted\n");
  terminal.type("set time-limit 5000\ncheck\n");
  ASSERT_TRUE(terminal.shows("% decided, ")) << terminal.seen();
  ASSERT_TRUE(terminal.shows("s left")) << terminal.seen();
  terminal.type("\x03");
  ASSERT_TRUE(terminal.shows("POSSIBLE PROBLEM")) << terminal.seen();
  ASSERT_TRUE(terminal.shows("regulus robot_2 table5_30> "));
  terminal.type("quit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

TEST(ShellAtATerminal, AnInterruptAtThePromptGivesAnotherPrompt) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("half a li\x03");
  ASSERT_TRUE(terminal.shows("regulus> "));
  EXPECT_EQ(terminal.exit_code_at_end_of_file(), 0);
}

TEST(ShellAtATerminal, TakesLettersOfAnyAlphabet) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("load Prüfstand\xff.toml\n");
  ASSERT_TRUE(terminal.shows("'Prüfstand?.toml': no such file")) << terminal.seen();
  terminal.type("quit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

TEST(ShellAtATerminal, TabTypesWhatHasToFollow) {
  const TemporaryDirectory home;
  Terminal terminal(home.path().string());
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("loa\t" REGULUS_SOURCE_DIR "/models/planar_3rp\t\n");
  ASSERT_TRUE(terminal.shows("motions regular")) << terminal.seen();
  terminal.type("motion cro\t\nsho\tse\t\n");
  ASSERT_TRUE(terminal.shows("motion crossing\r\n")) << terminal.seen();
  terminal.type("quit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

TEST(ShellAtATerminal, KeepsItsHistoryForItsOwnerAlone) {
  const TemporaryDirectory home;
  const auto file = home.path() / ".local/state/regulus/history";
  {
    Terminal terminal(home.path().string());
    ASSERT_TRUE(terminal.shows("regulus> "));
    terminal.type("help quit\n");
    ASSERT_TRUE(terminal.shows("exit code"));
    terminal.type("quit\n");
    ASSERT_EQ(terminal.exit_code(), 0);
  }
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  std::ifstream kept(file);
  const std::string lines{std::istreambuf_iterator<char>(kept), {}};
  EXPECT_THAT(lines, HasSubstr("quit"));
}

TEST(ShellAtATerminal, NeedsNoHome) {
  Terminal terminal("/dev/null/nowhere");
  ASSERT_TRUE(terminal.shows("regulus> "));
  terminal.type("motions\n");
  ASSERT_TRUE(terminal.shows("no model is loaded"));
  terminal.type("quit\n");
  EXPECT_EQ(terminal.exit_code(), 0);
}

}  // namespace
}  // namespace regulus::detail::test
