// SPDX-License-Identifier: Apache-2.0
// All poses of a platform on three legs in the plane, as all solutions of equations. PROOF.md, "All
// poses in the plane".
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

inline constexpr std::size_t kLegsInPlane = 3;

/// Puts the equations of the legs, and where x, y and phi can be, into `question.closure`.
///
/// Requires  question.solutions has three legs and no closure. Throws Rejection for a line `solution`
///           with an angle that is too large.
void form_planar_equations(Question& question);

}  // namespace regulus::verifier
