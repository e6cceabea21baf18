// SPDX-License-Identifier: GPL-3.0-or-later
// A page of the manual: a Markdown file whose fenced blocks say what is to be done with them.
//
//   ```console            commands, each after "$ ", and below it what it prints
//   ```toml file=a.toml   (any language) a file that the commands below it use
//   ```toml from=a.toml   an excerpt of a file of the project: consecutive lines of it
//
// Of what is printed a line "..." stands for any number of lines, a word "…" for any word, "0.21…"
// for any that begins so. Numbers agree to three digits; lines that begin with "time" or "method",
// which tell of the machine, with their first word.
#pragma once

#include <string>
#include <vector>

namespace regulus::test {

struct Block {
  std::string language, attribute, value;  ///< console, file or from, its value
  std::vector<std::string> lines;
  std::size_t first_line = 0;  ///< of the page; 0 is its first
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

/// The commands of a console block. A command goes on after a line that ends in a backslash.
[[nodiscard]] std::vector<Step> steps_of(const Block& block);

/// Whether what was printed is what the page shows.
[[nodiscard]] bool agrees(const std::vector<std::string>& shown,
                          const std::vector<std::string>& printed);

}  // namespace regulus::test
