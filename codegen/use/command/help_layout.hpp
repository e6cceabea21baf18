// SPDX-License-Identifier: GPL-3.0-or-later
// The layout of --help: options by what they are for, and examples.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace regulus::detail {

/// Returns the groups of options in the order of --help: the question, the budget, the output,
/// research, and the rest.
[[nodiscard]] const std::vector<std::string>& option_groups();

/// Gives every option of a command that --help shows its group.
void group_options(CLI::App& command);

/// Returns the text of CLI11 for a value; of a choice "{a,b}".
[[nodiscard]] std::string without_check(const std::string& type);

/// Returns command lines that show what a command is for, each with a line about it; empty for the
/// program itself.
[[nodiscard]] std::string examples_of(const std::string& command);

/// Prints the groups in their order, lines of at most 80 columns, defaults at the end of what is
/// said of an option, and the examples before the footer.
class GroupedHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  [[nodiscard]] std::string groups_of(const CLI::App& app) const;
};

}  // namespace regulus::detail
