// SPDX-License-Identifier: Apache-2.0
// The theorem about the branch of a closure, over ranges or along pieces, whole or paved, and about a
// quantity over it.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/pieces.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Reads the proof, and returns what follows the first lines of the file. `kept`: the lines of the
/// question. Throws Unfinished if there is no such theorem; Rejection if the certificate is none.
[[nodiscard]] std::string coq_closure(Lines& lines, const Question& question,
                                      const std::vector<std::string>& kept, const Pieces& pieces);

}  // namespace regulus::verifier
