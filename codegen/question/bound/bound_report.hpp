// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a bound.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail {

/// Returns "BETWEEN 21.12 AND 21.29 N (leg 3)", or the verdict about a limit.
[[nodiscard]] std::string describe_bound(const Bound& bound, const BoundSettings& settings);

/// The two ends of a component's bracket as decimals that claim no more than they do, the lower one
/// first; empty: not known.
struct EndTexts {
  std::string low, high;
};
[[nodiscard]] EndTexts end_texts(const ComponentBound& component);

/// Returns the lines about the question: model, motion, the set of the claim, the quantity, its limit.
[[nodiscard]] std::string format_asked(const Request& request, const Quantity& quantity,
                                       const std::optional<GiNaC::ex>& limit);

/// Returns one line about a component.
[[nodiscard]] std::string format_component(const ComponentBound& component, bool has_limit);

/// Returns what the components took together.
[[nodiscard]] StageSeconds seconds_of(const Bound& bound);
[[nodiscard]] std::uint64_t boxes_of(const Bound& bound);

/// Tells the bracket or the verdict about the limit, without the model and the question. No `attained` or
/// `proved` claims more than the exact text beside it.
void tell_bracket(const Request& request, const Bound& bound, const BoundSettings& settings,
                  Facts& facts);

/// Tells all but the lines of format_asked() and format_component(), which people read before.
void tell_bound(const Request& request, const Bound& bound, const BoundSettings& settings,
                Facts& facts);

}  // namespace regulus::detail
