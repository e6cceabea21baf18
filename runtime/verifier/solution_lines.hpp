// SPDX-License-Identifier: Apache-2.0
// The lines of a question about all solutions at one place: FORMAT.md, "All solutions".
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Reads the lines `leg` and `solution`, from the current one on. Throws Rejection.
void read_solution_lines(Lines& lines, Question& question);

inline constexpr std::string_view kFromLine = "from ";
/// Reads the lines `from` of a proof, from the current one on: all solutions have one, with so many
/// numbers, or none has. Throws Rejection.
void read_from_lines(Lines& lines, SolutionLines& claim, std::size_t numbers);

}  // namespace regulus::verifier
