// SPDX-License-Identifier: GPL-3.0-or-later
// The singularity that was found, for people and for programs: the proof, a pose close to it, and
// what is lost there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "codegen/analysis/least_singular.hpp"
#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline report {

[[nodiscard]] nlohmann::ordered_json json_point(const PreparedSearch& preparation,
                                                const WitnessPoint& point);

/// null without a witness.
[[nodiscard]] nlohmann::ordered_json json_witness(const PreparedSearch& preparation,
                                                  const Result& result);

/// Nothing without a witness.
[[nodiscard]] std::string format_witness(const PreparedSearch& preparation, const Result& result);

/// Where a matrix is nearest to losing rank, when nothing could be proved.
[[nodiscard]] nlohmann::ordered_json json_nearest(const PreparedSearch& preparation,
                                                  const LeastSingular& nearest);
[[nodiscard]] std::string format_nearest(const PreparedSearch& preparation,
                                         const std::optional<LeastSingular>& nearest);

}  // namespace regulus::inline report
