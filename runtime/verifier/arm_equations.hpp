// SPDX-License-Identifier: Apache-2.0
// All postures of an arm as all solutions of equations. PROOF.md, "All postures".
#pragma once

#include <optional>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Opposite joints of six, which follow from the other four: 1 and 4, 2 and 5, 3 and 6.
inline constexpr std::size_t kPairsOfJoints = 3;

/// Two free joints, of which no other joint follows one. They follow from the others.
struct JointPair {
  std::size_t first = 0, second = 0;
  bool are_opposite = false;  ///< if a joint slides, it is one of them
};

/// Equations in some of the free joints, which each posture solves.
struct PostureSearch {
  Question question;  ///< with these equations, and their unknowns, in its closure
  std::vector<std::size_t> searched{};  ///< the unknowns, as numbers of the free joints
  std::vector<NodeId> also{};           ///< each is 0 at each posture, too
  NodeId trace = kNoNode;               ///< of all joints, in the question of these; see below
  bool has_none = false;                ///< the place has an orientation that is none of the arm
};

/// Puts the equations of all free joints, within their ranges, into `question.closure`, and returns those without two
/// of them, if these are given. The equations of all have solutions of two kinds: at a posture `trace` is 3, and
/// otherwise −1.
///
/// Requires  question.solutions has an arm, and there is no closure.
/// Throws    Rejection for a line `solution` with a value that is too large, if a joint to be searched slides without a
///           range, or if the two are none that may be left out; Unfinished as read_moving_arm does.
[[nodiscard]] PostureSearch form_posture_equations(Question& question,
                                                   std::optional<JointPair> left_out);

}  // namespace regulus::verifier
