// SPDX-License-Identifier: Apache-2.0
// The certificate of a quantity over the branch of a closure: Rates.v has its proof, or Slopes.v. The
// motors are the pose parameters; each becomes a variable by its error, which is 0 if the certificate states none.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

struct BranchQuantityText {
  std::string question;             ///< the lines about the closure, with an error of each motor
  std::vector<std::size_t> places;  ///< by variable of the certificate: its number among these
  std::string definitions;          ///< of Coq: the motors, the quantity, the vectors, the limits
  std::string claim, arguments;     ///< `branch_within`, ` the_motors …`
};

/// Returns true for a claim about the derivatives of the equations by the unknowns: it has no motors.
[[nodiscard]] bool is_about_slopes_of_branch(const Question& question);

/// Takes the quantity out of the lines of a certificate, which are those of `question`. Throws
/// Unfinished if there is no theorem about it; Rejection if a spread or a radius is negative.
[[nodiscard]] BranchQuantityText split_branch(const Question& question,
                                              const std::vector<std::string>& lines);

}  // namespace regulus::verifier
