// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a report, whole: what is uncertain and by how much, ranges, options, version.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/engine/pipeline.hpp"

namespace regulus::inline report {

/// Returns the question: ranges and uncertain quantities as they were searched, [lower, upper]
/// rounded outward; the options of the search; the version. With the model file of the report's
/// hash it can be asked again.
[[nodiscard]] nlohmann::ordered_json json_question(const PreparedSearch& preparation,
                                                   const SearchOptions& search);

/// Returns "base ±0.05, platform ±0.1 in balls": the groups of uncertain quantities.
///
/// Requires  some quantity is uncertain.
[[nodiscard]] std::string describe_tolerances(const PreparedSearch& preparation);

}  // namespace regulus::report
