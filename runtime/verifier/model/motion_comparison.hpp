// SPDX-License-Identifier: Apache-2.0
// Compares the motion of a question with that of a model file.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

/// Compares the threshold, parameters, poses with their errors, and the lines constraint, reach and
/// motion-defined. `poses`: the names of the pose parameters. `compared`: keys of Question::stated
/// that way-points give. Call it after the matrix has been compared. `section`: may be null.
void compare_motion(QuestionComparer& comparer, SectionReading* section,
                    const std::vector<std::string>& poses, const std::set<std::string>& compared);

}  // namespace regulus::verifier
