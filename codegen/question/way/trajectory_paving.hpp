// SPDX-License-Identifier: GPL-3.0-or-later
// Divides a motion along a trajectory into stretches: free, singular, undecided, outside, out of
// reach.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/facts.hpp"
#include "codegen/question/way/trajectory_run.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// The default resolution: the part of a segment that is left undecided.
inline constexpr double kPathResolution = 0x1p-9;

/// A place on the trajectory: 0 ≤ s ≤ 1 on a piece, which is counted from 0.
struct PathPlace {
  std::size_t piece = 0;
  double s = 0;
};

/// A part of the trajectory from one place to another.
///
/// Ensures   the claim holds for this part, for all control errors and all values of the uncertain
///           quantities. A singular one contains a singular pose for some of these.
struct PathStretch {
  Claim claim = Claim::kUndecided;
  Reason reason = Reason::kAllBoxesCertified;  ///< of its first part, if it is undecided
  PathPlace begin, end;
};

/// Adds a part that begins where the last stretch ends; it continues one with the same claim.
void append_stretch(std::vector<PathStretch>& stretches, const PathStretch& part);

/// Returns the word for the claim of a stretch.
using ClaimWord = const char* (*)(Claim) noexcept;

struct PathPaving {
  /// Without deciding piece, and with trees if they are wanted; its verdict is that of the paving.
  TrajectoryCheck check;
  std::optional<DecidingPiece> singular;  ///< the first piece that was shown to be singular
  double resolution = 1;                  ///< part of a segment
  std::vector<PathStretch> stretches;     ///< in order, without gaps

  /// Returns the part of the claim in the time of the trajectory, approximately, in [0, 1].
  [[nodiscard]] double approx_share(Claim claim) const;
};

/// Returns the time at a place, to nearest: for people.
[[nodiscard]] double approx_time_at(const Trajectory& trajectory, const PathPlace& place);
/// Returns the part of a claim in the time of a trajectory, approximately, in [0, 1].
[[nodiscard]] double approx_share_of(const Trajectory& trajectory,
                                     const std::vector<PathStretch>& stretches, Claim claim);
/// Tells the stretches, a line each, and the share of each of `claims`.
void tell_stretches(const Trajectory& trajectory, const std::vector<PathStretch>& stretches,
                    std::span<const Claim> claims, ClaimWord word, Facts& facts);
/// Returns one stretch as an object: its claim, its segments, its lines and its times.
[[nodiscard]] nlohmann::ordered_json json_stretch_of(const Trajectory& trajectory,
                                                     const PathStretch& stretch, ClaimWord word);

/// Divides the trajectory of a request, which took `model_seconds` to read. A part of a segment
/// that is neither certified nor singular is not divided further at `resolution`.
/// Throws as check_trajectory.
[[nodiscard]] PathPaving pave_trajectory(Request request, double model_seconds,
                                         SearchOptions search, double resolution, bool wants_trees,
                                         const PathWatch& watch);

/// Writes a proof of the verdict, as certify_trajectory: of the whole motion, or of one pose.
[[nodiscard]] ProofStatus certify_path_paving(const std::string& path, PathPaving& paving,
                                              const ProofPlacing& placing);

/// Tells the question, the stretches and the share of each claim.
void tell_path_paving(const PathPaving& paving, const SearchOptions& search, Facts& facts);

/// Returns one stretch as an object: its claim, its segments, its lines and its times.
[[nodiscard]] nlohmann::ordered_json json_stretch(const PathPaving& paving,
                                                  const PathStretch& stretch);

}  // namespace regulus::detail
