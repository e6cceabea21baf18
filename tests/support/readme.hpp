// SPDX-License-Identifier: GPL-3.0-or-later
// What the README shows, for the tests that run it.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

namespace regulus::test {

/// The lines under "$ regulus …" in the README, or in that of a folder.
[[nodiscard]] inline std::string shown_in_readme(const std::string& command,
                                                 const std::string& path = "README.md") {
  std::ifstream readme(REGULUS_SOURCE_DIR "/" + path);
  std::string line, shown;
  while (std::getline(readme, line) && line != "$ " + command) continue;
  while (std::getline(readme, line) && line != "```") shown += line + '\n';
  return shown;
}

/// What does not differ from run to run.
[[nodiscard]] inline std::string without_timings(const std::string& text) {
  std::istringstream lines(text);
  std::string line, kept;
  while (std::getline(lines, line))
    if (!line.starts_with("time ") && !line.starts_with("method ")) kept += line + '\n';
  return kept;
}

}  // namespace regulus::test
