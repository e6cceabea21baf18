// SPDX-License-Identifier: GPL-3.0-or-later
// Shows a prompt at a terminal; otherwise reads a script.
#include "codegen/use/shell/shell_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <iostream>

#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "codegen/use/shell/line_editor.hpp"
#include "codegen/use/shell/shell_session.hpp"

namespace regulus::detail {
namespace {

/// True if a code is that of an error, and not of a verdict.
bool is_error(int code) { return code >= kUsageError; }

/// During its lifetime, SIGINT only ends a read; a search handles it itself.
class InterruptsReading {
 public:
  InterruptsReading() {
    struct sigaction action {};
    action.sa_handler = [](int) {};
    sigaction(SIGINT, &action, &previous_);
  }
  ~InterruptsReading() { sigaction(SIGINT, &previous_, nullptr); }
  InterruptsReading(const InterruptsReading&) = delete;
  InterruptsReading& operator=(const InterruptsReading&) = delete;

 private:
  struct sigaction previous_ {};
};

/// Returns the code of the last line with a verdict. Only quit and the end of the input end it.
int at_prompt(ShellSession& session) {
  const InterruptsReading reading;
  std::cerr << session.greeting();
  LineEditor editor(history_file(), [&session](const std::string& before) {
    return completions(before, session.names());
  });
  while (!session.ended()) {
    const std::optional<std::string> line = editor.next(session.prompt());
    if (!line) break;
    static_cast<void>(report_errors([&] { return session.execute(*line); }, "regulus: "));
  }
  return 0;
}

int as_script(ShellSession& session, ErrorFormat format) {
  int last = 0;
  std::string line;
  for (int number = 1; !session.ended() && std::getline(std::cin, line); ++number) {
    const int code = report_errors([&] { return session.execute(line); },
                                   "regulus: line " + std::to_string(number) + ": ", format);
    const std::string command = line.substr(0, line.find_first_of(" \t"));
    static constexpr std::array<const char*, 9> kWithVerdict = {
        "check", "locate", "margin", "bound", "datasheet", "solve", "report", "verify", "plot"};
    const bool has_verdict = std::ranges::find(kWithVerdict, command) != kWithVerdict.end();
    if (is_error(code) || has_verdict) last = code;
    if (is_error(code) && !session.keeps_going()) return code;
  }
  return last;
}

}  // namespace

int run_shell(const ShellCommand& command) {
  ShellSession session(command.json);
  if (!command.path.empty()) static_cast<void>(session.execute("load '" + command.path + "'"));
  if (isatty(STDIN_FILENO) != 0) return at_prompt(session);
  return as_script(session, command.json ? ErrorFormat::kJson : ErrorFormat::kText);
}

}  // namespace regulus::detail
