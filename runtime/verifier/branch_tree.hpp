// SPDX-License-Identifier: Apache-2.0
// The tree of a proof about a closure, with its tubes: are they of one branch, that of the start?
#pragma once

#include <deque>

#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

/// A box is split; or it is a leaf, with a tube or without.
struct BranchNode {
  std::int32_t variable = -1;  ///< that is split; -1: a leaf
  std::uint32_t next = 0;  ///< the lower part, before the upper one; of a leaf its tube + 1, or 0
  double at = 0;
  std::uint32_t depth = 0;
};

/// The shard that is read.
struct ShardOfTree {
  std::size_t number = 0;  ///< from 1; 0: the proof is in one file
  std::size_t listed = 0;  ///< its line in the index
};

/// The place of the line of a leaf.
struct LeafPlace {
  std::size_t line;
  ShardOfTree shard;

  /// Returns "7", or "7 of shard 2".
  [[nodiscard]] std::string text() const;
};

/// The boxes of a tree that is checked, for the piece of a motion that follows it.
struct BranchBoxes {
  std::vector<BranchNode> nodes{1};  ///< by the number of the box
  std::deque<TubeNumbers> tubes{};
  std::vector<LeafPlace> lines{};  ///< by tube
};

/// Returns the numbers of a leaf's tube; none if it is outside. Throws Rejection. `words`: of the line.
[[nodiscard]] TubeNumbers read_tube(const Question& question,
                                    const std::vector<std::string_view>& words);

/// Returns the tubes of the leaves in which a place may lie. Throws Rejection if one has no tube.
[[nodiscard]] std::vector<std::size_t> tubes_at(const BranchBoxes& boxes, const Box& place);

class BranchTree {
 public:
  /// All must outlive this object.
  BranchTree(Question& question, const Variety& variety, const Options& options, WorkClock& clock)
      : q_(question), variety_(variety), options_(options), clock_(clock) {}

  /// Box `number` is cut; its parts have the next two numbers. Throws Unfinished.
  void split(std::uint64_t number, std::size_t variable, double at);
  /// Adds a leaf. Throws Unfinished. `tube`: as read_tube() returns it.
  void add_leaf(std::uint64_t number, const TubeNumbers& tube, std::size_t line);
  /// The next lines are those of this shard.
  void begin_shard(const ShardOfTree& shard) { shard_ = shard; }

  /// Requires  the leaves tile box 0, and the claim of each is proved.
  /// Ensures   returns only if the tubes hold one continuous configuration, which is at the start the
  ///           only one within the radius of the start, and if the question has a place where a value is
  ///           attained, attains it there; throws Rejection or Unfinished otherwise. A piece of a PAVING
  ///           that follows another one may have no tube.
  /// `before`: of the piece of a motion that this one follows, as PROOF.md, "Pieces of a closure", says;
  /// then its tubes, where its first variable is 1, have the configurations that those of this tree
  /// have where it is 0, and there is no start. May be null.
  void check(Lines& lines, Verification& result, const BranchBoxes* before = nullptr);
  /// After check(): the start was shown to be a point of the set.
  [[nodiscard]] bool starts_in_set() const noexcept { return starts_in_set_; }
  /// Returns the boxes. Nothing else may be asked after that.
  [[nodiscard]] BranchBoxes take_boxes() { return std::move(boxes_); }

 private:
  [[nodiscard]] static bool is_leaf(const BranchNode& node) { return node.variable < 0; }

  void link(std::size_t node, Box& box);
  void link_across(std::size_t lower, std::size_t upper, std::size_t cut, Box& common);
  void descend(std::size_t node, std::size_t other, bool is_lower, std::size_t cut, Box& common);
  void require_link(std::size_t a, std::size_t b, const Box& face);
  void require_link(const BranchBoxes& of_a, std::size_t a, std::size_t b, const Box& at_a,
                    const Box& at_b);
  void require_joint(const BranchBoxes& before);
  void check_start();
  void check_value();
  void require_start(std::size_t tube, const Box& place, const SolutionBox& solution);
  [[nodiscard]] std::uint32_t root_of(std::uint32_t tube);
  void require_connection();
  [[noreturn]] void give_up(std::size_t tube, bool is_rejection, const std::string& why);

  Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  BranchBoxes boxes_;
  ShardOfTree shard_;
  std::size_t numbers_ = 0;  ///< of all tubes

  // For check.
  Lines* lines_ = nullptr;
  const BranchBoxes* below_ = &boxes_;  ///< the boxes below the cuts of link_across()
  std::optional<BranchTest> test_;
  std::vector<std::uint32_t> joined_to_;  ///< by tube: another one of the same part
  std::uint64_t links_ = 0, steps_ = 0;
  bool starts_in_set_ = false;
};

}  // namespace regulus::verifier
