// SPDX-License-Identifier: Apache-2.0
// The lines of a certificate about the bound of a quantity: FORMAT.md, "Bounds of quantities".
#pragma once

#include "runtime/verifier/question.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// Reads from the current line, `quantity KIND`, up to the line after `bound` or `unbounded`. Throws
/// Rejection.
///
/// Requires  the lines of the model and the motion have been read.
void read_quantity_lines(Lines& lines, Question& question);

/// Returns true for a name of letters, digits, '_' and '-'.
[[nodiscard]] bool is_label(std::string_view text);

/// Sets Verification::bound: the number of the bound as a decimal. Of a matrix with one parameter
/// more than the poses have, as that of a bound, it says that the claim has no number.
void describe_bound(const Question& question, Verification& result);

/// Returns true if the node is the number 0 itself.
[[nodiscard]] bool is_zero_number(const Graph& graph, NodeId node);

/// Returns true if the set is its own mirror image about 0: all middles are the number 0.
[[nodiscard]] bool is_symmetric(const Graph& graph, const VectorSetLines& set);

}  // namespace regulus::verifier
