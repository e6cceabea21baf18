// SPDX-License-Identifier: GPL-3.0-or-later
// Poses and uncertain values in reports.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "codegen/question/engine/pipeline.hpp"

namespace regulus {

[[nodiscard]] bool is_motion(const VariableLabel& variable);
[[nodiscard]] std::size_t uncertain_count(const PreparedSearch& preparation);
/// More uncertain quantities than this are counted for people, not listed.
inline constexpr std::size_t kMostListed = 8;

/// Returns bounds of variable k. The ends of its whole range are written as in the model, because
/// the outward and inward roundings enclose them.
[[nodiscard]] std::string range_text(const PreparedSearch& preparation, std::size_t k,
                                     const Interval& x);

/// Returns values of the motion parameters, or of the other variables, by name.
[[nodiscard]] nlohmann::ordered_json json_parameters(const PreparedSearch& preparation,
                                                     std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_uncertain(const PreparedSearch& preparation,
                                                    std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_pose(const PreparedSearch& preparation,
                                               std::span<const Interval> pose);

/// Returns "x = 3, y = [4, 5]": the motion parameters, in the shortest decimals that determine
/// them. Ends of the variety are written as in the model.
[[nodiscard]] std::string describe_place(const PreparedSearch& preparation,
                                         std::span<const Interval> variables);
/// The same with six digits.
[[nodiscard]] std::string describe_short_place(const PreparedSearch& preparation,
                                               std::span<const Interval> variables);
/// Returns "with a = 1, b = 2": the uncertain quantities, or their number if there are many; empty
/// if there are none.
[[nodiscard]] std::string describe_uncertain_values(const PreparedSearch& preparation,
                                                    std::span<const Interval> variables);
/// Returns "where the pose is x = 3, y = 4"; empty if the motion parameters are its parameters.
[[nodiscard]] std::string describe_pose_of(const PreparedSearch& preparation,
                                           std::span<const Interval> pose);
/// The same with six digits.
[[nodiscard]] std::string describe_short_pose(const PreparedSearch& preparation,
                                              std::span<const Interval> pose);

}  // namespace regulus
