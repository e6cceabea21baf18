// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a singularity, for people and for programs: the proof, a pose close to it, and the
// twists lost there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "codegen/question/analysis/least_singular.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

[[nodiscard]] nlohmann::ordered_json json_point(const PreparedSearch& preparation,
                                                const WitnessPoint& point);

/// Returns null without a witness.
[[nodiscard]] nlohmann::ordered_json json_witness(const PreparedSearch& preparation,
                                                  const Result& result);

/// Returns an empty text without a witness.
[[nodiscard]] std::string format_witness(const PreparedSearch& preparation, const Result& result);

/// Returns the place where a matrix is nearest to losing rank, if nothing could be proved or if it is
/// almost singular there.
[[nodiscard]] nlohmann::ordered_json json_nearest(const PreparedSearch& preparation,
                                                  const LeastSingular& nearest);
[[nodiscard]] std::string format_nearest(const PreparedSearch& preparation,
                                         const std::optional<LeastSingular>& nearest);

}  // namespace regulus
