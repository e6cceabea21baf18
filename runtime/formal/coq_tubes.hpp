// SPDX-License-Identifier: Apache-2.0
// The tubes of a proof about a closure as a tree of Coq.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// The variables of a certificate among those of a theorem, which may have more.
struct VariablesOfCoq {
  std::vector<std::size_t> places;  ///< by variable of the certificate: its number
  std::size_t count = 0;
};

/// Reads the proof of a closure, and returns its definition `the_tubes`: the cuts and the tubes, which
/// are hints for Coq. `pieces`: so many trees, as a list; 0: the question has no pieces. Throws Rejection
/// if they are no trees.
[[nodiscard]] std::string coq_tubes(Lines& lines, const Question& question,
                                    const VariablesOfCoq& variables, std::size_t pieces);

}  // namespace regulus::verifier
