// SPDX-License-Identifier: GPL-3.0-or-later
// A page of the manual: a Markdown file; the heads of its fenced blocks say what to do with them.
//
//   ```console            commands, each after "$ ", and below each its output
//   ```toml file=a.toml   (any language) a file that the commands below it use
//   ```toml from=a.toml   an excerpt of a file of the project: consecutive lines of it
//
// In the output, a line "..." matches any lines, a word "…" any word, "0.21…" any word that begins
// so. Numbers agree to three digits, and names of instruction sets agree with each other. Lines
// that begin with "time" always agree.
#pragma once

#include <string>
#include <vector>

namespace regulus::detail::test {

struct Block {
  std::string language, attribute, value;  ///< console, file or from, its value
  std::vector<std::string> lines;
  std::size_t first_line = 0;  ///< of the page; 0 is the first
};

struct Page {
  std::vector<std::string> lines;
  [[nodiscard]] std::vector<Block> blocks() const;
};

struct Step {
  std::string command;
  std::vector<std::string> output;
  std::size_t first_line = 0;  ///< of the output
};

[[nodiscard]] Page read_page(const std::string& path);
void write_page(const std::string& path, const Page& page);

/// Returns the commands of a console block. A backslash at the end of a line continues a command.
[[nodiscard]] std::vector<Step> steps_of(const Block& block);

/// Returns true if the output is the one that the page shows.
[[nodiscard]] bool agrees(const std::vector<std::string>& shown,
                          const std::vector<std::string>& printed);

}  // namespace regulus::detail::test
