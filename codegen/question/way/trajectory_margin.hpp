// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the largest safe tolerance, threshold or tube of a motion along a trajectory.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/facts.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/margin/margin_run.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus::detail {

struct TrajectoryMargin {
  Margin margin;
  TrajectoryCheck last;                    ///< the last check
  std::optional<TrajectoryCheck> refuted;  ///< the check at the least value that is not safe
  EndProofs proofs;
};

/// Checks the trajectory at one value after another. `request`: its motion has a trajectory.
/// `proofs`: of both ends. `settings`: but for its limits. Throws as check_trajectory; FileError.
[[nodiscard]] TrajectoryMargin margin_of_trajectory(
    const MarginRequest& request, const MarginQuestion& question, const SearchOptions& search,
    double gap, const OutputOptions& output, BracketSettings settings, EndProofs proofs = {});

/// Tells the motion, and people which quantities of the geometry are uncertain, with a tolerance that
/// grows.
void tell_growing_way(const Request& request, const MarginQuestion& question, Facts& facts);
/// Tells the bracket and the check at its unsafe end.
void tell_trajectory_margin(const TrajectoryMargin& found, const MarginQuestion& question,
                            const SearchOptions& search, double gap, Facts& facts);

}  // namespace regulus::detail
