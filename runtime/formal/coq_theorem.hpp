// SPDX-License-Identifier: Apache-2.0
// Lets Coq decide if a file is a theorem, and asks Coq what it proved.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::verifier {

/// The claim, then the theorems about a robot.
struct ProvedTheorem {
  std::vector<std::string> statements;
  bool may_be_empty = false;  ///< as in PlainTheorem
};

/// Proves the theorem of a file of the plain grammar (coq_audit.hpp) by coqc. A second file, of this
/// program, states the claim anew, by the whole paths of its names, and the theorems about a robot, by
/// the words of Geometry.v alone, lets Coq compare the types, and lists the axioms. `library`: as in find_coq_library.
///
/// Throws Rejection: the file is not plain, Coq refuses it, its theorem states something else, or
/// rests on an axiom that the library does not have. CoqTimeout; std::runtime_error if coqc or the
/// library cannot be used.
[[nodiscard]] ProvedTheorem prove_by_coq(std::string_view text, const std::string& library,
                                         double time_limit);

/// Throws Rejection if the answer to `Print Assumptions` has more than the axioms of the library.
void check_assumptions(std::string_view answer);

}  // namespace regulus::verifier
