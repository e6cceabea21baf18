// SPDX-License-Identifier: Apache-2.0
// The poses of a platform on three legs in the plane as configurations: each leg is an equation.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the lines of a certificate about the configurations of a closure with the unknowns x, y and phi, which
/// claims the same of the poses of `question`, within ranges that have all of them.
///
/// `lines`: those of `question`, a claim about the poses of a platform on three legs in the plane. Throws Rejection
/// for a line `solution` with an angle that is too large; Unfinished if a number is too large, or not certain.
[[nodiscard]] std::string poses_as_configurations(Question question,
                                                  const std::vector<std::string>& lines);

}  // namespace regulus::verifier
