// SPDX-License-Identifier: GPL-3.0-or-later
// An arm whose end is where the joints or the tool of a motion put it, and the systems that are searched
// for its postures.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/arm_unknowns.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

struct ArmAtPlace {
  ArmGeometry geometry;
  ArmChain chain;  ///< of the joints that are free; those that are held are parts of its links
  LinkFrame target;
  std::vector<ArmUnknown> unknowns;  ///< those of the chain

  /// True if each joint is an unknown.
  [[nodiscard]] bool is_plain() const;
};

/// `held`: joints that keep their values, beside those to which a motion by the tool gives one. Joints that
/// follow them keep theirs, too.
///
/// Requires  request.model.arm; the motion has values.
/// Throws    UsageError for an arm that has not six joints that are free to move and follow none.
[[nodiscard]] ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held);

/// The number of the system of all six unknowns. Those before it are of four joints of a plain arm, and the other two
/// are opposite: N + 2 and N + 5 modulo 6 in the system of number N. Those behind it are of four unknowns of an arm
/// with joints that follow others, and number the pair of the other two.
inline constexpr std::size_t kWholeArm = 6;
/// If all joints turn, each pair of opposite ones has one number, below this.
inline constexpr std::size_t kOppositePairs = 3;

/// Returns the numbers of the systems in four unknowns, the best one first: none if several joints of a plain
/// arm slide, or if fewer than two of another arm have no followers.
[[nodiscard]] std::vector<std::size_t> systems_of_four(const ArmAtPlace& arm);

/// The unknowns of a system of four, in their order, and the other two.
struct FourUnknowns {
  std::array<std::size_t, 4> searched{};
  std::array<std::size_t, 2> following{};
};

/// Requires  of these three: number is one of systems_of_four(), for the last one also kWholeArm.
[[nodiscard]] FourUnknowns four_unknowns(std::size_t number);
/// Returns the two that follow from values of the four, approximately.
[[nodiscard]] std::array<double, 2> approx_following(const ArmAtPlace& arm, std::size_t number,
                                                     std::span<const double> four);
[[nodiscard]] RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number);

}  // namespace regulus::detail
