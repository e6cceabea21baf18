// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string_view>

#include "codegen/support/exit_code.hpp"
#include "codegen/support/terminal_width.hpp"
#include "codegen/support/visible_text.hpp"
#include "codegen/support/wrapped_text.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kPlain = "\033[0m";

const char* colour_of(int exit_code) {
  if (exit_code == kNoSingularity) return "\033[1;32m";
  return exit_code == kSingularity ? "\033[1;31m" : "\033[1;33m";
}

}  // namespace

bool takes_colours(int file) {
  const char* const forbidden = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  return (forbidden == nullptr || *forbidden == '\0') && terminal != nullptr && *terminal != '\0' &&
         std::string_view(terminal) != "dumb" && ::isatty(file) != 0;
}

void print_report(const std::string& text) {
  std::cerr << visible(for_file(STDERR_FILENO, text), true);
}

std::string for_file(int file, const std::string& report) {
  return ::isatty(file) == 0 ? report : wrapped_report(report, columns_of_terminal(file));
}

void print_answer(const std::string& text, int exit_code) {
  if (takes_colours(STDOUT_FILENO))
    std::cout << colour_of(exit_code) << text << kPlain << '\n';
  else
    std::cout << text << '\n';
}

}  // namespace regulus::detail
