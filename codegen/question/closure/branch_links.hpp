// SPDX-License-Identifier: GPL-3.0-or-later
// Shows that the tubes of all boxes hold one branch, and that it begins at the model's start.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/branch_search.hpp"

namespace regulus::detail {

/// The place where a branch begins: its configuration there is the only one within the radius of the
/// values. Each number encloses the exact one.
struct BranchStart {
  std::vector<Interval> place;   ///< by variable; of uncertain ones their middles
  std::vector<Interval> values;  ///< by unknown
  std::vector<Interval> radius;  ///< by unknown, positive
};

/// Says that an interrupt or a limit ends the work.
using MustStop = std::function<std::optional<Reason>()>;

struct BranchLinks {
  bool is_one_branch = false;             ///< every box with a tube is on it
  std::vector<char> on_branch{};          ///< by leaf
  std::vector<Interval> configuration{};  ///< encloses the unknowns at the start
  std::size_t links = 0;
  /// Why it is not shown to be one branch; empty if it is.
  std::string obstacle{};
  std::optional<Reason> stopped_by{};  ///< what ended the work before its end
};

/// The branch up to where another piece of the motion begins: there its first variable, which ends at
/// `end`, has the value `begin` on the next piece, and the equations of both are equal.
struct BranchBefore {
  const BranchTree& tree;
  double end = 1, begin = 0;
};

/// Encloses the one configuration of the branch at the joint, where the variables but the first are
/// in the middle; nullopt if it is not found. `question`: of the next piece.
[[nodiscard]] std::optional<std::vector<Interval>> configuration_after(
    const ClosureQuestion& question, const BranchBefore& before);

/// Two neighbours have one branch if their tubes hold the same solution at one place of the face that
/// they share: the branches of both are continuous on it, and each is unique in its tube. Those of
/// the start hold there the solution that is the only one near BranchStart::values. Boxes are on
/// the branch if such links join them with those, and each pair of neighbours among them is linked.
/// A tube that holds another branch than its neighbour is replaced, if one is found from there.
///
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] BranchLinks link_branch(const ClosureQuestion& question, BranchTree& tree,
                                      const BranchStart& start, const MustStop& must_stop);
/// The same of a branch that goes on from another piece: each pair of boxes that meet at the joint must
/// hold the same solution there.
[[nodiscard]] BranchLinks link_branch(const ClosureQuestion& question, BranchTree& tree,
                                      const BranchBefore& before, const MustStop& must_stop);

}  // namespace regulus::detail
