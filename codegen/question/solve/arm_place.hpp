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

/// The number of the system of all six joints. Those before it are of four joints, and the other two are
/// opposite: N + 2 and N + 5 modulo 6 in the system of number N.
inline constexpr std::size_t kWholeArm = 6;
/// If all joints turn, each pair of opposite ones has one number, below this.
inline constexpr std::size_t kOppositePairs = 3;

/// Returns the numbers of the systems of four joints that there are: none if more than one joint slides.
[[nodiscard]] std::vector<std::size_t> opposite_systems(const ArmChain& chain);

/// Returns the loop that the system of this number of four joints is about, and its end.
[[nodiscard]] std::pair<ArmChain, LinkFrame> loop_from(const ArmAtPlace& arm, std::size_t number);

/// Requires  number: kWholeArm, or one of opposite_systems().
[[nodiscard]] RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number);

}  // namespace regulus::detail
