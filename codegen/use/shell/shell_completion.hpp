// SPDX-License-Identifier: GPL-3.0-or-later
// The completions of Tab in the shell, as a function of the line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// The names that can be completed at a moment.
struct ShellNames {
  std::vector<std::string> commands;
  std::vector<std::string> installed;  ///< models
  std::vector<std::string> motions;
  std::vector<std::string> parameters;  ///< of the chosen motion
  std::vector<std::string> groups;      ///< of tolerances
  std::vector<std::string> options;     ///< of `check`, without the dashes
  std::vector<std::string> lets;
  std::vector<std::string> loads;
  std::vector<std::string> twists;
  std::vector<std::string> quantities;  ///< of `bound`
  /// Returns the options of a command, with the dashes; empty for a command of the shell alone.
  std::function<std::vector<std::string>(const std::string& command)> options_of;
  /// Returns the values of an option; empty if any text is allowed.
  std::function<std::vector<std::string>(const std::string& option)> values_of;
  /// Returns the files and folders (with a slash) whose path begins with `prefix`.
  std::function<std::vector<std::string>(const std::string& prefix)> files;
};

/// Returns the completions of the last word before the cursor, in order.
[[nodiscard]] std::vector<std::string> completions(std::string_view line, const ShellNames& names);

/// Returns the longest common beginning.
[[nodiscard]] std::string common_beginning(const std::vector<std::string>& words);

/// Reads the file system for ShellNames::files; nothing if it cannot be read.
[[nodiscard]] std::vector<std::string> files_beginning(const std::string& prefix);

}  // namespace regulus::detail
