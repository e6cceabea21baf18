// SPDX-License-Identifier: GPL-3.0-or-later
// Says what a verdict means for the robot, for readers who do not think in matrices. The claim beside it is
// what is proved.
#pragma once

#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/engine/search_subject.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Tells the sentence as "meaning", null if the verdict proves nothing. `subject` has the matrix, the
/// threshold, and the quantities that are uncertain.
void tell_meaning(const SearchSubject& subject, Verdict verdict, Reason reason, Facts& facts);

/// The same for words of another question; empty: nothing is proved.
void tell_meaning(const std::string& words, Facts& facts);

/// Tells what the colours of a paving mean; null with a threshold. `part`: what has a colour.
void tell_meaning_of_parts(const SearchSubject& subject, const char* part, Facts& facts);

/// Returns the claim of a question that is left open.
[[nodiscard]] std::string nothing_proved(const std::string& reason);

}  // namespace regulus::detail
