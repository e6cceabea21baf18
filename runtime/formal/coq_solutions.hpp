// SPDX-License-Identifier: Apache-2.0
// The lines of a list of configurations for Coq: Solutions.v has their proof.
#pragma once

#include <string>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the definition `the_solutions`: the lines `solution` of a claim about all solutions of a closure,
/// as decimals.
///
/// Requires: `question` has been read, and has a closure and solutions.
/// Rounding: each interval of Coq contains that of the certificate. Its ends have few digits: it is wider by at most
/// a fifth, or has the least part of its range that doubles can decide.
[[nodiscard]] std::string coq_solutions(const Question& question);

}  // namespace regulus::verifier
