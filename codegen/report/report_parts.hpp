// SPDX-License-Identifier: GPL-3.0-or-later
// What the reports of several commands have in common: numbers, places, and the lines that say what
// was asked and how it was decided.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline report {

/// [lo, hi]; JSON has no infinities, a bound that is one becomes null.
[[nodiscard]] nlohmann::ordered_json json_interval(const Interval& x);

/// Values of the motion parameters, or of the other variables, by name.
[[nodiscard]] nlohmann::ordered_json json_parameters(const PreparedSearch& preparation,
                                                     std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_uncertain(const PreparedSearch& preparation,
                                                    std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_pose(const PreparedSearch& preparation,
                                               std::span<const Interval> pose);
[[nodiscard]] nlohmann::ordered_json json_seconds(const StageSeconds& seconds);
[[nodiscard]] const char* json_name(Verdict verdict);
/// How many of a search's boxes came before the compiler was asked, {"interpreted", "compiled"}:
/// all or none of them where the engine is one from the start. When the compiler was done is left
/// out, since it differs from run to run: until then the latter are interpreted, too.
[[nodiscard]] nlohmann::ordered_json json_engine_boxes(const PreparedSearch& preparation,
                                                       const SearchOptions& search,
                                                       std::uint64_t boxes);

/// Short enough to read; never used for anything that is certified.
[[nodiscard]] std::string short_interval(const Interval& x);

/// The threshold in a claim: as many digits, six at least, as it takes to be within the enclosure,
/// from the end that claims less: the lower one in "|det| > α", the upper one in "|det| ≤ α".
[[nodiscard]] std::string threshold_text(const Interval& alpha, bool exceeded);
/// " cm"; nothing for the unit 1.
[[nodiscard]] std::string unit_suffix(const std::string& unit);
[[nodiscard]] bool is_motion(const VariableLabel& variable);
[[nodiscard]] std::size_t uncertain_count(const PreparedSearch& preparation);
/// "x = 3, y = [4, 5]": the motion parameters, in the shortest decimals that determine them. Ends
/// of the variety are written as the model has them.
[[nodiscard]] std::string describe_place(const PreparedSearch& preparation,
                                         std::span<const Interval> variables);
/// The same with six digits.
[[nodiscard]] std::string describe_short_place(const PreparedSearch& preparation,
                                               std::span<const Interval> variables);
/// The uncertain quantities, in a line of its own; that there are many, if there are.
[[nodiscard]] std::string format_uncertain_values(const PreparedSearch& preparation,
                                                  std::span<const Interval> variables);
/// The pose in a line of its own; nothing when the motion parameters are its parameters.
[[nodiscard]] std::string format_pose(const PreparedSearch& preparation,
                                      std::span<const Interval> pose);
[[nodiscard]] std::string format_short_pose(const PreparedSearch& preparation,
                                            std::span<const Interval> pose);
/// "full 6×6 matrix"
[[nodiscard]] std::string describe_size(const PreparedSearch& preparation);

/// The lines about model, motion and uncertain quantities.
[[nodiscard]] std::string format_question(const PreparedSearch& preparation);
/// The line about method and engine, after a search of `boxes`.
[[nodiscard]] std::string format_method(const PreparedSearch& preparation,
                                        const SearchOptions& search, Method method,
                                        std::uint64_t boxes);
[[nodiscard]] std::string format_time(const StageSeconds& seconds);
/// How much was made of the model's expressions: "full", "small-parts", "as-written"; null where
/// the forming was stopped.
[[nodiscard]] nlohmann::ordered_json json_forms(const PreparedSearch& preparation);
/// The answer to whether the constraints leave any pose: true, false or null, and a line of doubt.
[[nodiscard]] nlohmann::ordered_json json_occupancy(const Result& result);
[[nodiscard]] std::string format_occupancy(const Result& result);

}  // namespace regulus::inline report
