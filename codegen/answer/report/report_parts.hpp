// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of the reports of several commands: numbers, places, and the lines about question
// and method.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// Returns [lo, hi]; an infinite bound becomes null, because JSON has no infinities.
[[nodiscard]] nlohmann::ordered_json json_interval(const Interval& x);

/// Returns values of the motion parameters, or of the other variables, by name.
[[nodiscard]] nlohmann::ordered_json json_parameters(const PreparedSearch& preparation,
                                                     std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_uncertain(const PreparedSearch& preparation,
                                                    std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_pose(const PreparedSearch& preparation,
                                               std::span<const Interval> pose);
[[nodiscard]] nlohmann::ordered_json json_seconds(const StageSeconds& seconds);
[[nodiscard]] const char* json_name(Verdict verdict);
/// Returns the numbers of boxes before and after the compilation was requested, {"interpreted",
/// "compiled"}; one of them is 0 if the engine never changes. The end of the compilation is left
/// out, since it differs from run to run: until then, boxes of the second number are interpreted,
/// too.
[[nodiscard]] nlohmann::ordered_json json_engine_boxes(const PreparedSearch& preparation,
                                                       const SearchOptions& search,
                                                       std::uint64_t boxes);

/// Returns "50 000".
[[nodiscard]] std::string in_thousands(std::uint64_t count);

/// Returns a short text for people; never used for certified values.
[[nodiscard]] std::string short_interval(const Interval& x);

/// Returns the threshold in a claim, with six digits, or more if needed to be within the enclosure.
/// It uses the end that claims less: the lower one in "|det| > α", the upper one in "|det| ≤ α".
[[nodiscard]] std::string threshold_text(const Interval& alpha, bool exceeded);
/// Returns " cm", for example; nothing for the unit 1.
[[nodiscard]] std::string unit_suffix(const std::string& unit);
[[nodiscard]] bool is_motion(const VariableLabel& variable);
[[nodiscard]] std::size_t uncertain_count(const PreparedSearch& preparation);
/// Returns "x = 3, y = [4, 5]": the motion parameters, in the shortest decimals that determine
/// them. Ends of the variety are written as in the model.
[[nodiscard]] std::string describe_place(const PreparedSearch& preparation,
                                         std::span<const Interval> variables);
/// The same with six digits.
[[nodiscard]] std::string describe_short_place(const PreparedSearch& preparation,
                                               std::span<const Interval> variables);
/// Returns a line with the uncertain quantities, or with their number if there are many.
[[nodiscard]] std::string format_uncertain_values(const PreparedSearch& preparation,
                                                  std::span<const Interval> variables);
/// Returns a line with the pose; nothing if the motion parameters are its parameters.
[[nodiscard]] std::string format_pose(const PreparedSearch& preparation,
                                      std::span<const Interval> pose);
[[nodiscard]] std::string format_short_pose(const PreparedSearch& preparation,
                                            std::span<const Interval> pose);
/// Returns "full 6×6 matrix", for example.
[[nodiscard]] std::string describe_size(const PreparedSearch& preparation);

/// Returns the lines that the model gives about its matrix; often there are none.
[[nodiscard]] std::string format_matrix_notes(const PreparedSearch& preparation);

/// Returns the poses that a claim is about: "pose of the variety", "reachable pose of the variety".
[[nodiscard]] const char* describe_pose(const PreparedSearch& p);
/// Returns a line if some poses of the motion are no part of the claim.
[[nodiscard]] std::string format_where(const PreparedSearch& p);

/// Returns the lines about model, motion, matrix and uncertain quantities.
[[nodiscard]] std::string format_question(const PreparedSearch& preparation);
/// Returns the line about method and engine, after a search of `boxes`.
[[nodiscard]] std::string format_method(const PreparedSearch& preparation,
                                        const SearchOptions& search, Method method,
                                        std::uint64_t boxes);
[[nodiscard]] std::string format_time(const StageSeconds& seconds);
/// Returns the detail of the forms: "full", "small-parts", "as-written"; null if forming was
/// stopped.
[[nodiscard]] nlohmann::ordered_json json_forms(const PreparedSearch& preparation);
/// Returns true, false or null: whether the constraints leave any pose. The text has a warning if
/// this is not known.
[[nodiscard]] nlohmann::ordered_json json_occupancy(const Result& result);
[[nodiscard]] std::string format_occupancy(const Result& result);

}  // namespace regulus
