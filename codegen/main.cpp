// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cfenv>
#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "codegen/support/errors.hpp"
#include "codegen/support/shell_word.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "codegen/use/shell/shell_command.hpp"
#include "codegen/use/shell/shell_session.hpp"

namespace {

using namespace regulus;
using namespace regulus::detail;

/// Ignores SIGXFSZ, so that a file size limit is reported as an error and does not end the process.
void report_file_limits() { std::signal(SIGXFSZ, SIG_IGN); }

/// Sets the default arithmetic: a library that was loaded before may have changed the rounding, or
/// flush subnormals. Reading numbers and new threads would inherit that.
void start_with_the_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

/// Returns the exit code of the command, unless its output could not be written.
int with_output_written(int exit_code) {
  std::cout.flush();
  if (!std::cout) throw FileError("cannot write standard output");
  return exit_code;
}

/// Returns the command as a shell reads it, with only the name of the program: its path has no meaning
/// elsewhere.
std::string typed(int argc, char** argv) {
  std::vector<std::string> words{"regulus"};
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  return shell_command(words);
}

int run(const CommandLine& line, const std::string& typed) {
  return line.shell ? run_shell(*line.shell) : run_command_line(line, typed);
}

}  // namespace

int main(int argc, char** argv) {
  return report_errors(
      [&] {
        report_file_limits();
        start_with_the_usual_arithmetic();
        return with_output_written(
            run(parse_command_line(argc, argv, ShellSession::commands()), typed(argc, argv)));
      },
      "regulus: ", error_format(argc, argv));
}
