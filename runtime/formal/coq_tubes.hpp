// SPDX-License-Identifier: Apache-2.0
// The tubes of a proof about a closure as a tree of Coq.
#pragma once

#include <string>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Reads the proof of a closure, and returns its definition `the_tubes`: the cuts and the tubes, which
/// are hints for Coq. Throws Rejection if they are no tree.
[[nodiscard]] std::string coq_tubes(Lines& lines, const Question& question);

}  // namespace regulus::verifier
