// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of a file.
#pragma once

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace regulus::detail::attack {

using Lines = std::vector<std::string>;

[[nodiscard]] inline Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

[[nodiscard]] inline std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Returns "line 12: 'entry x' -> 'entry x + 1'".
[[nodiscard]] inline std::string described(std::size_t line, const std::string& before,
                                           const std::string& after) {
  return "line " + std::to_string(line + 1) + ": '" + before + "' -> '" + after + "'";
}

}  // namespace regulus::detail::attack
