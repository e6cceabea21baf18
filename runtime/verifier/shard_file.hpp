// SPDX-License-Identifier: Apache-2.0
// One file of a proof in shards.
#pragma once

#include <istream>

#include "runtime/verifier/input_file.hpp"
#include "runtime/verifier/tree_reader.hpp"

namespace regulus::verifier {

/// An entry of the index: one shard.
struct ListedShard {
  std::size_t number = 0;    ///< from 1
  std::uint64_t leaves = 0;  ///< or places
  std::string sha256;
  std::size_t line = 0;  ///< of the index
};

/// The words by which an index names its last line and what it counts.
struct ListedWords {
  const char *last, *counted, *shown;  ///< "end", "leaves", "LEAVES"
};

/// Reads the lines `shard NUMBER LEAVES SHA256` from the next one on, up to the end of the file, whose
/// last line has the sum. Throws Rejection.
[[nodiscard]] std::vector<ListedShard> read_listed(Lines& lines, const ListedWords& words);

/// Begins the text of a state between two lines: the number of the tree, from 0, and of its open boxes.
[[nodiscard]] std::string begin_of_state(std::size_t tree, std::size_t open);
/// Returns equal texts for equal states.
[[nodiscard]] std::string state_text(std::size_t tree, const OpenBoxes& open);

class ShardFile {
 public:
  /// Throws Rejection if the file cannot be read, is another shard, or has other bytes than the
  /// index says. `question`: SHA-256 of the question; empty: the shard has places of a table.
  ShardFile(const std::string& path, const ListedShard& listed, const std::string& question);

  /// Reads the line `piece`: returns the number, from 0, of the piece in or behind whose tree the
  /// shard begins. Throws Rejection. `most`: the number of pieces.
  [[nodiscard]] std::size_t read_piece(std::size_t most);
  /// Reads up to the line `proof`: the boxes that wait before the shard. Throws Rejection.
  [[nodiscard]] OpenBoxes read_open(const Box& root);
  [[nodiscard]] Lines& lines() noexcept { return lines_; }

 private:
  void advance();
  void require(const std::string& line, const std::string& otherwise);
  void read_box(const std::vector<std::string_view>& words, const Box& root, OpenBoxes& into) const;

  InputFile bytes_;
  std::istream stream_;
  Lines lines_;
};

}  // namespace regulus::verifier
