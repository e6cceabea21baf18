// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a report, whole: what is uncertain and by how much, ranges, options, version.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/engine/pipeline.hpp"

namespace regulus::detail {

/// Returns the question: ranges and uncertain quantities as they were searched, [lower, upper]
/// rounded outward, and the exact numbers as texts that model files and options take; the options
/// of the search; the version. With the model file of the report's hash it can be asked again.
///
/// The exact numbers are left out if `preparation` has other ranges than the request that it was
/// made for (PreparedSearch::is_replanned): give the request of the question then.
[[nodiscard]] nlohmann::ordered_json json_question(const PreparedSearch& preparation,
                                                   const SearchOptions& search);

/// Overload for a request: of a motion along way-points, everything but the poses.
///
/// Throws    InputError if a range has no certain value.
[[nodiscard]] nlohmann::ordered_json json_question(const Request& request,
                                                   const SearchOptions& search);

/// Returns everything of the question that the boxes of its search depend on, for a file from which
/// the search continues. Formulas are left out: their terms may have another order in another
/// process.
[[nodiscard]] nlohmann::ordered_json json_kept_question(const PreparedSearch& preparation,
                                                        const SearchOptions& search);

/// Returns a load or a twist set: {"name", "entries": [{"name", "value_exact", "tolerance_exact", "unit"}]};
/// of a member of a ball "radius_exact". `units`: of the entries.
[[nodiscard]] nlohmann::ordered_json json_vector_set(const VectorSet& set,
                                                     const std::vector<std::string>& units);

/// Returns "18 of base, 6 control errors": how many quantities of each group are uncertain.
[[nodiscard]] std::string describe_groups(const ReportLabels& labels);

/// Returns "18 of base ±0.05, 18 of platform ±0.1 in balls": the groups of uncertain quantities.
///
/// Requires  some quantity is uncertain.
[[nodiscard]] std::string describe_tolerances(const SearchSubject& preparation);

/// Returns "18 of base ±v, 6 of joints ±0.01 deg; v grows": the groups while those quantities grow that are
/// not in `before`.
///
/// Requires  some quantity is uncertain.
[[nodiscard]] std::string describe_growing_tolerances(const SearchSubject& grown,
                                                      const SearchSubject& before);

}  // namespace regulus::detail
