// SPDX-License-Identifier: GPL-3.0-or-later
// The claim about a branch has words; where it fails, a configuration shows so.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/closure/closure_way.hpp"

namespace regulus::detail {

/// Returns the claim, or why there is none, in words.
[[nodiscard]] std::string describe_claim(const PreparedClosure& prepared,
                                         const ClosureFinding& found);

/// Returns "the branch has exactly one configuration, and its 2×2 matrix of the equations' derivatives has
/// full rank", or what a threshold is: what is claimed of poses.
[[nodiscard]] std::string describe_regular_branch(const PreparedClosure& prepared);

/// Returns "|det| of its 2×2 matrix of the equations' derivatives is at most 0.5", or "is more than 0.5".
[[nodiscard]] std::string describe_threshold(const PreparedClosure& prepared, bool exceeded);

/// Returns the claim SINGULARITY. `where`: "the motion"; `by_fold`: of a singular configuration.
[[nodiscard]] std::string describe_refuted(const PreparedClosure& prepared,
                                           const std::string& where, bool by_fold);

/// Returns what a verdict says of the mechanism; nothing if nothing is proved. `poses`: "this motion".
[[nodiscard]] std::string describe_meaning(const PreparedClosure& prepared, Verdict verdict,
                                           bool by_fold, const char* poses);

/// Returns "where phi = 0.5 rad, psi = 1 rad".
[[nodiscard]] std::string describe_configuration(const PreparedClosure& prepared,
                                                 std::span<const Interval> unknowns);

/// Returns the commanded pose on a segment with its errors. `uncertain`: the uncertain quantities, which
/// have them.
[[nodiscard]] nlohmann::ordered_json json_pose_on(const PreparedWay& way, std::size_t piece,
                                                  const Interval& s,
                                                  const nlohmann::ordered_json& uncertain);

/// Tells the configuration where a threshold is not exceeded, as the witness. `way`: null over ranges.
void tell_below(const PreparedClosure& prepared, const PreparedWay* way,
                const std::optional<ThresholdFinding>& found, Facts& facts);

}  // namespace regulus::detail
