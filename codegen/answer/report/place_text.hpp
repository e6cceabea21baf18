// SPDX-License-Identifier: GPL-3.0-or-later
// Poses and uncertain values in reports.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "codegen/question/engine/search_subject.hpp"

namespace regulus::detail {

[[nodiscard]] bool is_motion(const VariableLabel& variable);
[[nodiscard]] std::size_t uncertain_count(const SearchSubject& preparation);
/// More uncertain quantities than this are counted for people, not listed.
inline constexpr std::size_t kMostListed = 8;

/// Returns doubles between which a text may show an end of a range: from the outer bound towards the
/// inner one, but not far, because the inner box of a ball is not near its outer one.
[[nodiscard]] Interval end_of_range(double outer, double inner);

/// Returns bounds of variable k. The ends of its whole range are written as in the model, because
/// the outward and inward roundings enclose them.
[[nodiscard]] std::string range_text(const SearchSubject& preparation, std::size_t k,
                                     const Interval& x);

/// Returns values of the motion parameters, or of the other variables, by name.
[[nodiscard]] nlohmann::ordered_json json_parameters(const SearchSubject& preparation,
                                                     std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_uncertain(const SearchSubject& preparation,
                                                    std::span<const Interval> variables);
[[nodiscard]] nlohmann::ordered_json json_pose(const SearchSubject& preparation,
                                               std::span<const Interval> pose);

/// Returns "x = 3, y = [4, 5]": the motion parameters, in the shortest decimals that determine
/// them. Ends of the variety are written as in the model.
[[nodiscard]] std::string describe_place(const SearchSubject& preparation,
                                         std::span<const Interval> variables);
/// The same with six digits.
[[nodiscard]] std::string describe_short_place(const SearchSubject& preparation,
                                               std::span<const Interval> variables);
/// Returns "with a = 1, b = 2": the uncertain quantities, or their number if there are many; empty
/// if there are none.
[[nodiscard]] std::string describe_uncertain_values(const SearchSubject& preparation,
                                                    std::span<const Interval> variables);
/// Returns "where the pose is x = 3, y = 4"; empty if the motion parameters are its parameters.
[[nodiscard]] std::string describe_pose_of(const SearchSubject& preparation,
                                           std::span<const Interval> pose);
/// The same with six digits.
[[nodiscard]] std::string describe_short_pose(const SearchSubject& preparation,
                                              std::span<const Interval> pose);

}  // namespace regulus::detail
