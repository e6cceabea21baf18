// SPDX-License-Identifier: Apache-2.0
// Lists of configurations at one place for Coq: Solutions.v has their proof.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

inline constexpr const char* kNoTheoremOfFollowed =
    "there is no theorem yet about solutions that one test does not show at all values of what is "
    "uncertain; regulus-verify follows them";

/// Returns the lines `solution` of a claim about all solutions of a closure, as decimals. `margin` begins
/// each line but the first.
///
/// Requires: `question` has been read, and has a closure and solutions.
/// Rounding: each interval of Coq contains that of the certificate. Its ends have few digits: it is wider by at most
/// a fifth, or has the least part of its range that doubles can decide.
[[nodiscard]] std::string coq_solutions(const Question& question, const std::string& margin);

/// Returns `(1.234, 1.236)`: the interval, with ends that have few digits, and at least the least part
/// of `range`, the size of the unknown, that doubles can decide.
[[nodiscard]] std::string coq_interval(const Interval& value, double range);

/// Returns the theorem about a list at one place, with its file.
///
/// Requires: `lines`, the lines of `question`, have been read, and it has solutions.
[[nodiscard]] std::string solutions_theorem(const Question& question,
                                            const std::vector<std::string>& lines);

/// Returns the definition `the_method` for such a theorem.
[[nodiscard]] std::string method_of_search(const Question& question);

}  // namespace regulus::verifier
