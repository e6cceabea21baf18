// SPDX-License-Identifier: Apache-2.0
// Pieces that are not of a trajectory: the sides of cuts of atan2.
//
// atan2(Y, X) jumps where Y = 0 and X < 0. Where s·Y ≥ 0, for s = 1 or −1, it is off its cut
// s·(π/2 + atan2(−X, s·Y)), which on the cut is the limit s·π. For n ordinates Y the sets of the 2ⁿ
// choices of signs cover every pose. So a question about the file is the same as 2ⁿ questions, each
// with the constraints −s·Y ≤ 0 and these expressions for the file's.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns true if the values of the pieces, by piece, are all choices of signs, each once.
[[nodiscard]] bool are_all_signs(const std::vector<std::vector<std::string>>& values);
/// Returns true if the last lines, up to `proof`, are "constraint -NAME*(Y)" for each name, in their
/// order, where Y has none of the names, nor one that is defined by them: then Y is the same in each
/// piece.
[[nodiscard]] bool end_in_sides(const std::string& lines, const std::vector<std::string>& names);

class CutSides {
 public:
  /// The signs of a piece, in their order. Requires  are_all_signs and end_in_sides were true.
  CutSides(Question& question, const std::vector<std::string>& signs);

  /// Returns the keys of Question::stated of the constraints −s·Y ≤ 0.
  [[nodiscard]] const std::vector<std::string>& constraints() const noexcept { return keys_; }
  /// Returns an expression of the file as it is on these sides.
  [[nodiscard]] NodeId on_sides(NodeId expression);

 private:
  struct Side {
    NodeId sign, ordinate;
  };
  [[nodiscard]] const Side* side_of(NodeId ordinate);

  Question& q_;
  std::vector<Side> sides_;
  std::vector<std::string> keys_;
  std::map<NodeId, const Side*> known_;  ///< by ordinate; null: it keeps its cut
};

}  // namespace regulus::verifier
