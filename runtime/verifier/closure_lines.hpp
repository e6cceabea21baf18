// SPDX-License-Identifier: Apache-2.0
// The lines of a question about a closure: FORMAT.md, "Closures".
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Reads the lines `unknown` and `start`, from the current one on. Adds the unknowns to the names of
/// the equations, `actual`; none may be in `commanded` or there. Throws Rejection.
void read_unknown_lines(Lines& lines, Question& question, const Scope& commanded, Scope& actual);

/// Reads the lines `equation`, from the current one on. Throws Rejection.
void read_equation_lines(Lines& lines, Question& question, const Scope& actual);

}  // namespace regulus::verifier
