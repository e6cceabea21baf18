// SPDX-License-Identifier: GPL-3.0-or-later
// Completions for shells, from the tables of the command line itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// The scripts complete commands, options and their values; and, of the model on the line, its
/// motions, and the parameters, groups, loads and twists that options name.
[[nodiscard]] std::string bash_completion(const std::vector<CommandEntry>& table);
[[nodiscard]] std::string zsh_completion(const std::vector<CommandEntry>& table);

}  // namespace regulus::detail
