// SPDX-License-Identifier: GPL-3.0-or-later
// The question of `regulus check --load` along the way-points of a file.
//
// All pieces are searched first, with one kernel of J⁻¹ in the pose parameters: a box of it is the
// hull of a part of the trajectory and of the control errors around it (question/way/path_parts.hpp).
// If forces hold the load at every pose of the box, they do so on that part. Nothing else is
// concluded from a box, because it contains poses beside the trajectory. Each piece that this leaves
// open gets a search of its own, over its exact parameter.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/question/load/feasibility_run.hpp"
#include "codegen/question/way/path_run.hpp"

namespace regulus::detail {

/// The piece that decides the verdict.
struct DecidingForces {
  std::size_t piece = 0;
  std::optional<PreparedForces> prepared;  ///< nullopt: it was not searched by itself
  FeasibilityResult result;
};

struct WayForces {
  Request request;      ///< with the trajectory
  PreparedForces hull;  ///< of the question about the box around the whole path
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  Reason reason = Reason::kAllBoxesCertified;
  std::optional<DecidingForces> deciding;  ///< none for FEASIBLE
  std::vector<TreeKept> trees;             ///< by piece, if they are wanted
  std::size_t searched_alone = 0;
  std::size_t excluded = 0;  ///< pieces without a pose that the constraints allow
  std::uint64_t boxes = 0;
  bool can_continue = false;  ///< a limit or an interrupt ended a search
  StageSeconds seconds;
};

/// Decides the question. `request`: its motion has a trajectory; it has been read in
/// `model_seconds`.
///
/// Ensures   FEASIBLE: at every pose of every piece that the constraints allow, with every control
///           error and value of the uncertain quantities, forces within the limits hold every wrench
///           of the load. The result does not depend on the threads.
/// Throws    as prepare_forces().
[[nodiscard]] WayForces check_forces_along_way(Request request, double model_seconds,
                                               const std::string& load, SearchOptions search,
                                               bool wants_trees, const PathWatch& watch);

/// Returns everything that the boxes depend on, for a checkpoint.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const Request& request,
                                                           const SearchOptions& search,
                                                           const std::string& load);

/// Tells the question, the claim and the segment where it fails.
void tell_way_forces(const WayForces& found, Facts& facts);

/// Returns the claim of FEASIBLE.
[[nodiscard]] std::string describe_claim(const WayForces& found);
/// Returns why neither answer was shown.
[[nodiscard]] std::string describe_reason(const WayForces& found);

}  // namespace regulus::detail
