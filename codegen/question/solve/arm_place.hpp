// SPDX-License-Identifier: GPL-3.0-or-later
// An arm whose end is where the joints or the tool of a motion put it, and the systems that are searched
// for its postures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

struct ArmAtPlace {
  ArmGeometry geometry;
  ArmChain chain;  ///< of the joints that are free; those that are held are parts of its links
  LinkFrame target;
  std::vector<std::size_t> free;  ///< by joint of the chain: its number in the pose
};

/// `held`: joints that keep their values, beside those to which a motion by the tool gives one.
///
/// Requires  request.model.arm; the motion has values.
/// Throws    UsageError for an arm that has not six joints that are free to move.
[[nodiscard]] ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held);

/// The number of the system of all six joints. Those before it are of four joints, two of them opposite
/// to two others.
inline constexpr std::size_t kWholeArm = 3;

/// Returns the loop that the system of this number of four joints is about, and its end.
[[nodiscard]] std::pair<ArmChain, LinkFrame> loop_from(const ArmAtPlace& arm, std::size_t number);

/// Requires  number ≤ kWholeArm; of another number than that, all joints turn.
[[nodiscard]] RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number);

}  // namespace regulus::detail
