// SPDX-License-Identifier: GPL-3.0-or-later
// A bound, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/bound/bound_run.hpp"

namespace regulus {

/// Returns "BETWEEN 21.12 AND 21.29 N (leg 3)", or the verdict about a limit.
[[nodiscard]] std::string describe_bound(const Bound& bound, const BoundSettings& settings);

/// The two ends of a component's bracket as decimals that claim no more than they do, the lower one
/// first; empty: not known.
struct EndTexts {
  std::string low, high;
};
[[nodiscard]] EndTexts end_texts(const ComponentBound& component);

/// Returns one line about a component.
[[nodiscard]] std::string format_component(const ComponentBound& component, bool has_limit);

/// Returns the report but for the lines of format_component() and describe_bound().
[[nodiscard]] std::string bound_report(const Request& request, const Bound& bound,
                                       const BoundSettings& settings);

/// Returns the JSON report. No `attained` or `proved` claims more than the exact text beside it.
[[nodiscard]] nlohmann::ordered_json json_bound(const Request& request, const Bound& bound,
                                                const BoundSettings& settings);
/// The same without the question.
[[nodiscard]] nlohmann::ordered_json json_bracket_of(const Request& request, const Bound& bound,
                                                     const BoundSettings& settings);

}  // namespace regulus
