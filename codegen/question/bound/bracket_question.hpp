// SPDX-License-Identifier: GPL-3.0-or-later
// The questions of regularity that the brackets and the comparisons of a bound ask.
#pragma once

#include <optional>

#include "codegen/question/margin/margin_question.hpp"
#include "codegen/question/quantity/bordered.hpp"

namespace regulus::detail {

/// Returns the question of a bracket of r, whose least value is 0.
[[nodiscard]] MarginQuestion question_of(const Bordered& bordered, MarginValue low,
                                         std::optional<MarginValue> high);
/// Returns the question with the limit as the upper end.
[[nodiscard]] MarginQuestion question_at_limit(const Bordered& bordered);

/// Returns a question about how far something may grow, as one about a component that keeps a limit.
[[nodiscard]] MarginQuestion question_within_limit(MarginQuestion question,
                                                   const Component& component,
                                                   const GiNaC::ex& limit);

/// Returns the request for the pieces of a motion along way-points that are searched alone: numbers
/// of the way-points would make each entry of combined columns long.
[[nodiscard]] Request request_of_pieces(const Bordered& bordered);

}  // namespace regulus::detail
