// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns an expression of det D·A, D the scales of the question. det A is multiplied out and nested
/// if exact algebra can do it, otherwise expanded by minors.
///
/// Ensures   it is the determinant wherever all entries have values. Throws Rejection if A has more than
///           8 rows.
[[nodiscard]] NodeId determinant_of(Question& question);

}  // namespace regulus::verifier
