// SPDX-License-Identifier: Apache-2.0
// Compares the section [closure] of a model file with the lines of a certificate about a closure.
#pragma once

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

/// Returns the question with its unknowns as further variables, near the start, and its equations as
/// the matrix: so the comparison, which knows no closures, can evaluate them and asks for their values.
[[nodiscard]] Question with_unknowns(const Question& question);

/// Requires  the comparer's question is with_unknowns of one about a closure.
void compare_closure(QuestionComparer& comparer);

}  // namespace regulus::verifier
