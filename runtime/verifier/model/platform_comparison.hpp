// SPDX-License-Identifier: Apache-2.0
// Compares a claim about finite errors of a platform on legs of variable length with a model file.
// PROOF.md, "Finite errors of a platform", says why the equations are those of the robot.
#pragma once

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

/// Compares the anchors, the equations of the legs, the errors of their motors and the start.
///
/// Requires  comparer.question() has a closure.
void compare_platform(QuestionComparer& comparer, SectionReading& section);

}  // namespace regulus::verifier
