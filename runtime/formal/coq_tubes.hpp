// SPDX-License-Identifier: Apache-2.0
// The tubes of a proof about a closure as a tree of Coq.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/coq_tree.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// A tree, or one for each piece.
using TreesOfTubes = std::vector<TreeOfBoxes>;

/// Reads the proof of a closure. `pieces`: so many trees; 0: the question has no pieces. Throws Rejection
/// if they are no trees.
[[nodiscard]] TreesOfTubes read_trees_of_tubes(Lines& lines, const Question& question,
                                               const VariablesOfCoq& variables, std::size_t pieces);

/// Returns the definition `the_tubes`: the cuts and the tubes, which are hints for Coq.
[[nodiscard]] std::string coq_tubes(const TreesOfTubes& trees, bool has_pieces);

}  // namespace regulus::verifier
