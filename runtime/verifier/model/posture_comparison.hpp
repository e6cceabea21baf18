// SPDX-License-Identifier: Apache-2.0
// Compares a claim about all postures of an arm with a model file.
#pragma once

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

/// Compares each joint, what it follows, its range, and the place of the end.
///
/// Requires  question.solutions has an arm; section is not null.
void compare_postures(QuestionComparer& comparer, SectionReading* section);

}  // namespace regulus::verifier
