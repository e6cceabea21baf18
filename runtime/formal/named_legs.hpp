// SPDX-License-Identifier: Apache-2.0
// The matrix of a robot on legs with the names that a proof gives its parts: those of `name_leg` in
// Legs.v.
#pragma once

#include "runtime/formal/named_matrix.hpp"

namespace regulus::verifier {

/// `in_degrees`: the angles of the pose are numbers of degrees. `of_pose`: as for read_named_matrix.
[[nodiscard]] NamedMatrix name_legs(RobotOfModel& robot, bool in_degrees, bool has_scales,
                                    bool of_pose);

}  // namespace regulus::verifier
