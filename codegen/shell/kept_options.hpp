// SPDX-License-Identifier: GPL-3.0-or-later
// The options that a session keeps for the commands that follow: those of `check`.
#pragma once

#include <string>
#include <vector>

#include "codegen/command/command_line.hpp"

namespace regulus::inline shell {

/// An option of `check`, named without its dashes; nullptr if there is none.
[[nodiscard]] const OptionEntry* option_of_check(const std::string& name);
/// False for what a session keeps by itself, or a command is to be told each time.
[[nodiscard]] bool may_be_kept(const std::string& option);
/// Of all that may be kept.
[[nodiscard]] std::vector<std::string> names_of_options();
/// Whether values begin with a name, and are set apart by it.
[[nodiscard]] bool takes_names(const std::string& option);

/// A command line was refused, and that has been said.
struct CommandLineRefused {
  int code;
};

/// Throws UsageError.
[[noreturn]] void refuse(const std::string& found, const std::string& expected);

}  // namespace regulus::inline shell
