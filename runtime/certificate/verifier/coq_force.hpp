// SPDX-License-Identifier: Apache-2.0
// The certificate of the bound of a force, as `regulus bound` writes it: its matrix is that of the
// robot, but for one row m, which is m - r·v. Here r is the last parameter, and v is the load,
// divided by the scale of the row. If the matrix is regular for each r up to R, the force of the row
// is below 1/R. Forces.v has the proof; it builds the matrix anew, so nothing here is trusted.
#pragma once

#include <string>
#include <vector>

#include "runtime/certificate/verifier/question.hpp"

namespace regulus::verifier {

struct ForceQuestion {
  std::string question;           ///< the lines of the certificate, without r
  std::size_t row = 0;            ///< the first is 0
  std::vector<std::string> load;  ///< v, an expression for each column
  std::string limit;              ///< 1/R
  bool is_two_sided = false;      ///< r is in [-R, R], and |force| < limit
};

/// Takes r out of the lines of a certificate, which are those of `bordered`. Throws Unfinished, with
/// the reason, if they are not those of a force.
[[nodiscard]] ForceQuestion split_force(const Question& bordered,
                                        const std::vector<std::string>& lines);

/// Returns the bound in words.
[[nodiscard]] std::string describe(const ForceQuestion& force);

}  // namespace regulus::verifier
