// SPDX-License-Identifier: Apache-2.0
// All postures of an arm of six joints, which turn but for at most one, as all solutions of equations.
// PROOF.md, "All postures".
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

inline constexpr std::size_t kJointsOfArm = 6;
/// Opposite joints, which follow from the other four: 1 and 4, 2 and 5, 3 and 6.
inline constexpr std::size_t kPairsOfJoints = 3;

/// Four equations in four of the six angles, which each posture solves.
struct PostureSearch {
  Question question;  ///< with these equations, and their unknowns, in its closure
  std::vector<std::size_t> searched{};  ///< the unknowns, as numbers of the six
  NodeId also = kNoNode;                ///< 0 at each posture, too
  NodeId trace = kNoNode;               ///< of all six, in the question of these; see below
};

/// Puts the equations of all six joints, angles within half a turn of the middle of the lines, into
/// `question.closure`, and returns those of four angles. The six have solutions of two kinds: at a
/// posture `trace` is 3, and otherwise −1. The joints 3 + pair and 6 + pair, modulo 6, follow from the
/// others; one of them is a joint that slides.
///
/// Requires  question.solutions has an arm, and there is no closure; pair < kPairsOfJoints.
/// Throws    Rejection for a line `solution` with a value that is too large, or if another joint slides; Unfinished if a number of
///           the arm has no certain value, or if a frame is not shown to be a rotation.
[[nodiscard]] PostureSearch form_posture_equations(Question& question, std::size_t pair);

}  // namespace regulus::verifier
