// SPDX-License-Identifier: Apache-2.0
// The first lines of a theorem's file, and its claim with the proof.
#pragma once

#include <string>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the first comment of a file, and its imports. `claim`: in words.
[[nodiscard]] std::string coq_heading(const Question& question, const std::string& claim);

/// The same with the claim of the question.
[[nodiscard]] std::string coq_heading(const Question& question);

/// Returns the theorem. `check`: the theorem that is applied, and its arguments.
[[nodiscard]] std::string coq_claim(const std::string& claim, const std::string& check);

}  // namespace regulus::verifier
