// SPDX-License-Identifier: Apache-2.0
// The certificate of the bound of a force, as `regulus bound` writes it: the question of the robot,
// and the lines of the quantity. Let one row m of the matrix become m - r·v, where v is the load,
// divided by the scale of the row. If that matrix is regular for each r up to R, the force of the row
// is below 1/R. Forces.v has the proof; it builds the matrix anew, so nothing here is trusted.
// Certificates of earlier versions have this matrix itself, and r as their last parameter.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

struct ForceQuestion {
  std::string question;           ///< the lines of the certificate, without r
  std::size_t row = 0;            ///< the first is 0
  std::vector<std::string> load;  ///< v, an expression for each column
  std::string limit;              ///< 1/R
  bool is_two_sided = false;      ///< r is in [-R, R], and |force| < limit
};

/// Takes the quantity, or r, out of the lines of a certificate, which are those of `question`. Throws
/// Unfinished, with the reason, if they are not those of a force.
[[nodiscard]] ForceQuestion split_force(const Question& question,
                                        const std::vector<std::string>& lines);

/// Returns the bound in words.
[[nodiscard]] std::string describe(const ForceQuestion& force);

}  // namespace regulus::verifier
