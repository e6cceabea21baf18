// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a singularity: the proof, a pose close to it, and the twists lost there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "codegen/answer/facts.hpp"
#include "codegen/question/analysis/least_singular.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

[[nodiscard]] nlohmann::ordered_json json_point(const SearchSubject& preparation,
                                                const WitnessPoint& point);

/// Tells it under the key `witness`, which is null without a witness.
void tell_witness(const PreparedSearch& preparation, const Result& result, Facts& facts);

/// Tells under the key `nearest_singular` where a matrix is nearest to losing rank, if nothing could
/// be proved or if it is almost singular there.
void tell_nearest(const SearchSubject& preparation, const LeastSingular& nearest, Facts& facts);

}  // namespace regulus::detail
