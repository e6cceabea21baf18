// SPDX-License-Identifier: GPL-3.0-or-later
// Searches all pieces of a trajectory with one kernel, whose variables are the pose parameters.
//
// A box of the kernel is the hull of a part of the trajectory and of the control errors around it.
// Parts are groups of pieces, pieces, and parts of pieces, split in s, in the errors and in the
// parameters that the motion has beside s. If every part is certified, so is the trajectory: each of its poses lies in some box. Nothing is concluded
// from a box that is not certified, because it contains poses beside the trajectory.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "codegen/question/way/path_parts.hpp"
#include "codegen/question/way/path_steps.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/shared_boxes.hpp"

namespace regulus::detail {

/// The kinds of leaves that a piece has.
struct PieceLeaves {
  bool within = false;   ///< some are about poses that the constraints allow
  bool outside = false;  ///< some lie outside a constraint that is not one of reach
  bool out_of_reach = false;

  /// True if every pose lies outside the constraints.
  [[nodiscard]] bool are_excluded() const noexcept { return !within && (outside || out_of_reach); }
};

struct PathSearchResult {
  std::vector<bool> certified;      ///< by piece
  std::vector<PieceLeaves> leaves;  ///< by piece
  std::vector<TreeKept> trees;      ///< by piece; empty unless they are wanted
  Statistics statistics;
  std::optional<Reason> stopped_by;
  std::size_t stopped_at = 0;  ///< a piece that was not reached then
};

/// A piece that needs more is left to a search of its own, which can also find a singularity.
inline constexpr std::uint32_t kMostBoxesOfPiece = 2048;

struct PathSearchOptions {
  std::size_t added = 0;      ///< parameters of the motion beside s
  std::size_t uncertain = 0;  ///< the uncertain quantities of a certificate
  bool wants_trees = false;
  std::size_t reach = 0;  ///< the first constraints of the kernel, which are those of reach
  std::uint32_t most_boxes = kMostBoxesOfPiece;  ///< of each piece
  const std::vector<bool>* skipped = nullptr;    ///< by piece; null: none. They count as certified
  Observer* progress = nullptr;  ///< receives what a display needs; null: there is none
  const SearchCheckpoint* checkpoint = nullptr;  ///< keeps the search; null: nothing does
  std::uint64_t boxes_before_workers = BoxSharing{}.boxes_before;
};

/// Requires  find_fault finds no fault. `problem`: its motion variables are path.moving() in order,
///           then `added` ones, and its ranges contain the whole path with its errors.
///
/// Ensures   a piece is certified only if the claim holds at all of its poses with all errors, for
///           all values of the added parameters and of the uncertain quantities. The result does not
///           depend on the threads, nor on the workers.
[[nodiscard]] PathSearchResult search_path(const PathBounds& path, const Problem& problem,
                                           const Settings& settings,
                                           const PathSearchOptions& options);

}  // namespace regulus::detail
