// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that a search of all pieces of a trajectory is split into, with their boxes and trees.
#pragma once

#include <cstdint>
#include <vector>

#include "codegen/question/way/path_bounds.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/proof/tree_kept.hpp"

namespace regulus::detail {

/// A part of the trajectory that is not decided yet.
struct PathPart {
  std::size_t piece = 0, pieces = 1;  ///< a group of pieces has neither number nor errors
  BoxId id = 0;
  std::uint32_t depth = 0;
  double begin = 0, end = 1;     ///< of s
  std::vector<Interval> errors;  ///< by moving parameter, then the added ones; empty: all
};

/// The variables of a kernel for all pieces that are certified: s, `added` parameters of the motion,
/// `uncertain` quantities, and the control errors.
struct PathVariables {
  std::size_t added = 0, uncertain = 0;
};

class PathParts {
 public:
  /// `problem`: its motion variables are path.moving() in order, then the added ones. Both arguments
  /// must live as long as this.
  PathParts(const PathBounds& path, const Problem& problem, const PathVariables& variables,
            bool wants_trees);

  /// Returns the whole trajectory as one group.
  [[nodiscard]] PathPart whole() const;
  /// Returns the number of the first piece after those of a part.
  [[nodiscard]] std::size_t end_of(const PathPart& part) const;
  /// Returns the number of halvings that lead from the whole trajectory to a part, for a display.
  [[nodiscard]] std::uint32_t depth_of(const PathPart& part) const;
  /// Sets the motion variables of a box to the hull of the part, with its control errors. The part
  /// lies in the ranges of the problem as well as in its own hull.
  void load_box(const PathPart& part, std::vector<Interval>& box) const;
  /// Appends the halves of a group.
  void split_group(const PathPart& part, std::vector<PathPart>& halves) const;
  /// Appends the halves of a part of one piece, split in what makes that variable wide: the part of
  /// the path, or its control error. An added parameter is split itself.
  ///
  /// Returns   false if the part is too small, or if nothing moves; then it is as it was.
  [[nodiscard]] bool split(PathPart& part, std::size_t variable, std::vector<PathPart>& halves);
  /// Notes a leaf in the tree of each of its pieces.
  void leaf(const PathPart& part, Rule rule);
  /// Returns the trees by piece; none unless they are wanted.
  [[nodiscard]] std::vector<TreeKept> take_trees() { return std::move(trees_); }

 private:
  [[nodiscard]] Interval commanded(const PathPart& part, std::size_t m) const;
  [[nodiscard]] Interval error_of(const PathPart& part, std::size_t m) const;

  const PathBounds& path_;
  const Problem& problem_;
  const bool wants_trees_;
  std::vector<std::size_t> number_;  ///< of an error or an added parameter in a certificate
  std::vector<Interval> ranges_;     ///< of all control errors and added parameters
  std::vector<BoxId> next_id_;
  std::vector<TreeKept> trees_;
};

}  // namespace regulus::detail
