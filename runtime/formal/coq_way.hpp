// SPDX-License-Identifier: Apache-2.0
// The way of a mechanism with loops as a definition of Coq.
#pragma once

#include <string>

#include "runtime/verifier/pieces.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the definition `pieces`: of a straight way its way-points, as decimals, and as degrees where a
/// number is a multiple of pi; of another one the numbers of its pieces. `question`: that of the first
/// piece. Throws Rejection for a number that is none; Unfinished for an arc, whose ends Coq does not
/// compare.
[[nodiscard]] std::string coq_way(const Pieces& pieces, const Question& question);

}  // namespace regulus::verifier
