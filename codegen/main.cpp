// SPDX-License-Identifier: GPL-3.0-or-later
#include <cfenv>
#include <csignal>
#include <iostream>
#include <string>

#include "codegen/command/run_command_line.hpp"
#include "codegen/shell/shell_command.hpp"
#include "codegen/shell/shell_session.hpp"
#include "codegen/support/errors.hpp"

namespace {

using namespace regulus;

/// A file that may not grow is trouble to be reported, not a signal to die of.
void report_file_limits() { std::signal(SIGXFSZ, SIG_IGN); }

/// A library that was loaded before may have changed the rounding, or have subnormals flushed:
/// reading numbers and starting threads would inherit that.
void start_with_the_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

/// The exit code says what was shown, unless nobody could read it.
int with_output_written(int exit_code) {
  std::cout.flush();
  if (!std::cout) throw FileError("cannot write standard output");
  return exit_code;
}

/// The words that were typed, the program by its name alone: a path means nothing elsewhere.
std::string typed(int argc, char** argv) {
  std::string command = "regulus";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

int run(const CommandLine& line, const std::string& typed) {
  return line.shell ? run_shell(*line.shell) : run_command_line(line, typed);
}

}  // namespace

int main(int argc, char** argv) {
  return report_errors([&] {
    report_file_limits();
    start_with_the_usual_arithmetic();
    return with_output_written(
        run(parse_command_line(argc, argv, ShellSession::commands()), typed(argc, argv)));
  });
}
