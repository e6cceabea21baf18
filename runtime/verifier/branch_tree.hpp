// SPDX-License-Identifier: Apache-2.0
// The tree of a proof about a closure, with its tubes: are they of one branch, that of the start?
#pragma once

#include <deque>

#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

class BranchTree {
 public:
  /// All must outlive this object.
  BranchTree(Question& question, const Variety& variety, const Options& options, WorkClock& clock)
      : q_(question), variety_(variety), options_(options), clock_(clock), nodes_(1) {}

  /// Box `number` is cut; its parts have the next two numbers. Throws Unfinished.
  void split(std::uint64_t number, std::size_t variable, double at);
  /// Adds a leaf, and returns the numbers of its tube; nullptr if it is outside. Throws Rejection or
  /// Unfinished. `words`: of the line.
  const TubeNumbers* add_leaf(std::uint64_t number, const std::vector<std::string_view>& words,
                              std::size_t line);

  /// Requires  the leaves tile box 0, and the claim of each is proved.
  /// Ensures   returns only if the tubes hold one continuous configuration, which is at the start the
  ///           only one within the radius of the start, and if the question has a value that is
  ///           attained, attains it at its place; throws Rejection or Unfinished otherwise.
  void check(Lines& lines, Verification& result);

 private:
  /// A box is split; or it is a leaf, with a tube or without.
  struct Node {
    std::int32_t variable = -1;  ///< that is split; -1: a leaf
    std::uint32_t next = 0;  ///< the lower part, before the upper one; of a leaf its tube + 1, or 0
    double at = 0;
    std::uint32_t depth = 0;
  };
  [[nodiscard]] static bool is_leaf(const Node& node) { return node.variable < 0; }

  void link(std::size_t node, Box& box);
  void link_across(std::size_t lower, std::size_t upper, std::size_t cut, Box& common);
  void descend(std::size_t node, std::size_t other, bool is_lower, std::size_t cut, Box& common);
  void require_link(std::size_t a, std::size_t b, const Box& face);
  void check_start();
  void check_value();
  void find_tubes(std::size_t node, const Box& place, std::vector<std::size_t>& tubes) const;
  void require_start(std::size_t tube, const Box& place, const SolutionBox& solution);
  [[nodiscard]] std::uint32_t root_of(std::uint32_t tube);
  void require_connection();
  [[noreturn]] void give_up(std::size_t tube, bool is_rejection, const std::string& why);

  Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  std::vector<Node> nodes_;  ///< by the number of the box
  std::deque<TubeNumbers> tubes_;
  std::vector<std::size_t> lines_of_;  ///< by tube
  std::size_t numbers_ = 0;            ///< of all tubes

  // For check.
  Lines* lines_ = nullptr;
  std::optional<BranchTest> test_;
  std::vector<std::uint32_t> joined_to_;  ///< by tube: another one of the same part
  std::uint64_t links_ = 0, steps_ = 0;
};

}  // namespace regulus::verifier
