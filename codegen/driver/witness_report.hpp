// SPDX-License-Identifier: GPL-3.0-or-later
// The singularity that was found, for people and for programs: the proof, a pose close to it, and
// what is lost there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "regulus/codegen/driver/least_singular.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/search/result.hpp"

namespace regulus::codegen {

[[nodiscard]] nlohmann::ordered_json json_point(const Preparation& preparation,
                                                const WitnessPoint& point);

/// null without a witness.
[[nodiscard]] nlohmann::ordered_json json_witness(const Preparation& preparation,
                                                  const Result& result);

/// Nothing without a witness.
[[nodiscard]] std::string witness_lines(const Preparation& preparation, const Result& result);

/// Where a matrix is nearest to losing rank, when nothing could be proved.
[[nodiscard]] nlohmann::ordered_json json_nearest(const Preparation& preparation,
                                                  const LeastSingular& nearest);
[[nodiscard]] std::string nearest_lines(const Preparation& preparation,
                                        const std::optional<LeastSingular>& nearest);

}  // namespace regulus::codegen
