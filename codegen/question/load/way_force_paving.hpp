// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus locate --load` along the way-points of a file: where is the load held?
#pragma once

#include "codegen/question/load/way_forces.hpp"
#include "codegen/question/way/trajectory_paving.hpp"

namespace regulus::detail {

/// A part of the trajectory from one place to another.
///
/// Ensures   the claim holds for this part, for all control errors and all values of the uncertain
///           quantities.
struct ForceStretch {
  ForceClaim claim = ForceClaim::kUndecided;
  PathPlace begin, end;
};

struct WayForcePaving {
  WayForces found;                      ///< its verdict is that of the paving
  double resolution = 1;                ///< part of a segment
  std::vector<ForceStretch> stretches;  ///< in order, without gaps

  /// Returns the part of the claim in the time of the trajectory, approximately, in [0, 1].
  [[nodiscard]] double approx_share(ForceClaim claim) const;
};

/// Divides the trajectory of a request, which took `model_seconds` to read. A part of a segment where
/// the load is neither held nor not held is not divided further at `resolution`.
/// Throws as prepare_forces().
[[nodiscard]] WayForcePaving pave_forces_along_way(Request request, double model_seconds,
                                                   const std::string& load, SearchOptions search,
                                                   double resolution, bool wants_trees,
                                                   const PathWatch& watch);

/// Returns the stretches, with the claims that stand for those about forces.
[[nodiscard]] std::vector<PathStretch> as_path_stretches(const WayForcePaving& paving);

/// Tells stretches with the claims that stand for those about forces, and the share of each.
void tell_force_stretches(const Trajectory& trajectory, double resolution,
                          const std::vector<PathStretch>& stretches, Facts& facts);
/// Tells the question, the stretches and the share of each claim.
void tell_way_force_paving(const WayForcePaving& paving, Facts& facts);

}  // namespace regulus::detail
