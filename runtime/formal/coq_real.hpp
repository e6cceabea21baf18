// SPDX-License-Identifier: Apache-2.0
// Expressions of a model file as real numbers of Coq, in the words of Geometry.v.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

/// Returns the node in the notation of Coq. `names`: an identifier or an expression in parentheses for
/// each variable. Throws Unfinished for a function that Geometry.v has no word for, and for an
/// expression that is too long.
[[nodiscard]] std::string coq_real(const Graph& graph, NodeId node,
                                   const std::vector<std::string>& names);

/// Returns a number of a model file as it is written, if Coq reads it so, or else its value. Throws
/// Unfinished for a text that is no number.
[[nodiscard]] std::string coq_written_number(std::string_view text, Graph& graph);

/// Returns the text as an argument of a function: in parentheses, unless it is a word or a number.
[[nodiscard]] std::string coq_argument(const std::string& text);

/// Joins the parts.
[[nodiscard]] std::string text_of(const std::vector<std::string>& parts, const char* between);

}  // namespace regulus::verifier
