// SPDX-License-Identifier: Apache-2.0
// Compares a claim about all poses of a platform, or all postures of an arm, with a model file.
#pragma once

#include "runtime/verifier/model/question_comparer.hpp"

namespace regulus::verifier {

/// The option that has set the place of a claim about all solutions.
inline constexpr const char* kPlaceOption = "at";
/// The option that names joints which keep their values.
inline constexpr const char* kHoldOption = "hold";

/// Compares the anchors of the legs, at the middles of their tolerances, and their lengths: those of
/// the motion, or those at its pose; or the joints of an arm, and the place of its end. `section`: may
/// be null.
void compare_robot_at_place(QuestionComparer& comparer, SectionReading* section);

}  // namespace regulus::verifier
