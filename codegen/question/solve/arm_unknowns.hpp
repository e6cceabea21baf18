// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns of an arm: each moves a joint that follows none, and the joints that follow it.
#pragma once

#include <vector>

#include "codegen/model/mechanism/serial.hpp"

namespace regulus::detail {

struct ArmUnknown {
  std::size_t pose =
      0;              ///< the number of the joint that follows none, among parameters of the pose
  bool turns = true;  ///< this joint does
  /// The joint's value is so many times the unknown. All joints that it moves are whole numbers of times
  /// it if they turn, so that 2π of the unknown bring all of them back: scale is 2 beside a follower of
  /// half its speed.
  double scale = 1;
  bool is_periodic = true;  ///< false: no number of turns is known to bring them back
  bool is_alone = true;     ///< no other joint moves with it
};

/// Returns them in the order of the pose.
[[nodiscard]] std::vector<ArmUnknown> unknowns_of(const Serial& arm);

/// The value of a joint: factor times the unknown, and an offset.
struct JointRule {
  std::size_t unknown = 0;
  GiNaC::ex factor = 1, offset = 0;
};
/// Returns them by joint, exactly.
[[nodiscard]] std::vector<JointRule> joint_rules(const Serial& arm);

}  // namespace regulus::detail
