// SPDX-License-Identifier: GPL-3.0-or-later
// The options that a session keeps for the commands that follow: those of `check`.
#pragma once

#include <string>
#include <vector>

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// Returns the options of a command of the command line, with their dashes; empty for other words.
[[nodiscard]] std::vector<std::string> options_of_command(const std::string& command);
/// Returns an option of `check` by its name without dashes; nullptr if there is none.
[[nodiscard]] const OptionEntry* option_of_check(const std::string& name);
/// False for an option that the session keeps elsewhere, or that each command needs anew.
[[nodiscard]] bool may_be_kept(const std::string& option);
/// Returns the names of all options that may be kept.
[[nodiscard]] std::vector<std::string> names_of_options();
/// Returns a line or more for each option that `set` takes, in groups.
[[nodiscard]] std::string describe_kept_options();
/// True if values begin with a name that distinguishes them.
[[nodiscard]] bool takes_names(const std::string& option);

/// A command line was refused; the message has been printed.
struct CommandLineRefused {
  int code;
};

/// Throws UsageError for words in the wrong form: "found FOUND, expected EXPECTED".
[[noreturn]] void refuse(const std::string& found, const std::string& expected);
/// Throws UsageError for any other mistake: "PROBLEM; REMEDY".
[[noreturn]] void reject(const std::string& problem, const std::string& remedy);

}  // namespace regulus::detail
