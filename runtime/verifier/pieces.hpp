// SPDX-License-Identifier: Apache-2.0
// The pieces of a trajectory: one question for all, with constants that each piece gives a value.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

/// The question of a trajectory of several pieces.
struct Pieces {
  std::vector<std::string> names;   ///< constants that each piece gives a value
  std::vector<std::string> values;  ///< of each piece: its values in the order of the names
  std::string before, after;        ///< the lines of the question, without those of the pieces
  std::string sha256;               ///< of the question, as ShardedTrees::sha256

  /// Returns the values of piece k as texts. Throws Rejection if their number is wrong.
  [[nodiscard]] std::vector<std::string> values_of(std::size_t k) const;
  /// Returns the question about piece k as a text of lines, each value a line `constant`.
  [[nodiscard]] std::string question_of(std::size_t k) const;
};

/// Reads on from the line `piecewise` to the line `proof`. Throws Rejection.
[[nodiscard]] Pieces read_pieces(Lines& lines);

/// Reads on from the line `piecewise`, up to the end of the file, and proves the claim for each
/// piece. `lines` has kept the lines before. `is_index`: the trees are in shards. Returns if the claim
/// is proved; throws Rejection, Unfinished or OtherModel.
void check_pieces(Lines& lines, bool is_index, const Options& options, Verification& result);

}  // namespace regulus::verifier
