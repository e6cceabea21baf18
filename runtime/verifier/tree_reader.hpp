// SPDX-License-Identifier: Apache-2.0
// The splits and leaves of a tree of boxes.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "runtime/verifier/branch_tree.hpp"
#include "runtime/verifier/leaf_proofs.hpp"

namespace regulus::verifier {

/// The boxes that wait at a place between two lines of a proof.
struct OpenBoxes {
  std::unordered_map<std::uint64_t, Box> boxes;  ///< by number
  std::uint64_t next = 1;                        ///< number of the next new box

  /// Returns numbers and ranges as text: equal texts for equal boxes.
  [[nodiscard]] std::string text() const;
};

class TreeReader {
 public:
  /// All must outlive this object. `proofs`: null if the leaves are proved elsewhere. `branch` receives
  /// the tree of a closure, and may be null.
  TreeReader(Lines& lines, const Question& question, OpenBoxes& open, LeafProofs* proofs,
             WorkClock& clock, BranchTree* branch = nullptr)
      : lines_(lines),
        question_(question),
        open_(open),
        proofs_(proofs),
        clock_(clock),
        branch_(branch) {}

  /// Reads up to the first line that is neither a split nor a leaf, and waits until all leaves
  /// before it are proved. Throws Rejection or Unfinished, for the first line that is wrong. Nothing is
  /// shown if the leaves are proved elsewhere.
  [[nodiscard]] Shown read();

  /// Throws Rejection unless the current line is a line 'end'.
  void require_end_word() const;
  /// Throws Rejection unless it gives this number of leaves and is the last line of the file.
  void require_end(std::uint64_t leaves);
  /// Throws Rejection if a box is open.
  void require_tiling() const;

 private:
  using Iterator = std::unordered_map<std::uint64_t, Box>::iterator;

  void read_boxes();
  [[nodiscard]] Iterator find(std::string_view text);
  void split(const std::vector<std::string_view>& words);
  void leaf(const std::vector<std::string_view>& words);

  Lines& lines_;
  const Question& question_;
  OpenBoxes& open_;
  LeafProofs* proofs_;
  WorkClock& clock_;
  BranchTree* branch_;
};

/// Throws Unfinished if the leaves of a whole tree are about no pose; notes it if they may be.
void require_poses(const Question& question, const Shown& shown, Verification& result);

}  // namespace regulus::verifier
