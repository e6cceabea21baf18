// SPDX-License-Identifier: Apache-2.0
// The tree of boxes of a proof, as lines `s` and `l` say it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

/// The variables of a certificate among those of a theorem, which may have more.
struct VariablesOfCoq {
  std::vector<std::size_t> places;  ///< by variable of the certificate: its number
  std::size_t count = 0;
};

/// A box: open, cut in two, or a leaf.
struct BoxOfTree {
  std::string word;       ///< of a leaf: its claim
  std::string tube;       ///< of a leaf that has one: its tube in Coq
  std::size_t lower = 0;  ///< the lower part; the upper one is the next box; 0: it is not cut
  std::size_t variable = 0;
  std::string place;  ///< of the cut: a hexadecimal double
  std::size_t depth = 0;
};

/// Box 0 is the first one. No box is open.
using TreeOfBoxes = std::vector<BoxOfTree>;

/// Returns the tube of a leaf, from the word of its claim and the words after it. Throws Rejection.
using TubeOfLeaf = std::function<std::string(std::string_view, std::span<const std::string_view>)>;

/// Reads on to the line after the tree. Throws Rejection if it is no tree.
[[nodiscard]] TreeOfBoxes read_tree_of_boxes(Lines& lines, const VariablesOfCoq& variables,
                                             const TubeOfLeaf& tube);

/// Throws Rejection unless the current line is that after the last tree.
void require_end_of_trees(Lines& lines);

/// Returns a double as Coq reads it.
[[nodiscard]] std::string coq_double(std::string_view word);

}  // namespace regulus::verifier
