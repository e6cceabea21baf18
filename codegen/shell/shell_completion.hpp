// SPDX-License-Identifier: GPL-3.0-or-later
// What Tab offers in the shell, as a function of the line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline shell {

/// The names that can be asked for at a moment.
struct ShellNames {
  std::vector<std::string> commands;
  std::vector<std::string> motions;
  std::vector<std::string> parameters;  ///< of the chosen motion
  std::vector<std::string> groups;      ///< of tolerances
  std::vector<std::string> options;     ///< of `check`, without the dashes
  std::vector<std::string> lets;
  /// What an option's value may be; empty if that is free.
  std::function<std::vector<std::string>(const std::string& option)> values_of;
  /// The files and folders (with a slash) whose path begins so.
  std::function<std::vector<std::string>(const std::string& prefix)> files;
};

/// What the last word of the line before the cursor can become, in order.
[[nodiscard]] std::vector<std::string> completions(std::string_view line, const ShellNames& names);

/// The longest text that all of them begin with.
[[nodiscard]] std::string common_beginning(const std::vector<std::string>& words);

/// What the file system has for ShellNames::files; nothing where it cannot be read.
[[nodiscard]] std::vector<std::string> files_beginning(const std::string& prefix);

}  // namespace regulus::inline shell
