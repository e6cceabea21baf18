// SPDX-License-Identifier: Apache-2.0
// The matrix of a robot on legs in the words of Legs.v.
#pragma once

#include "runtime/formal/coq_matrix.hpp"

namespace regulus::verifier {

/// `orientation`: of a platform in space, in the words of Geometry.v. `robot` gets the names of the
/// proof.
[[nodiscard]] WrittenMatrix write_legs(const Question& question, const WrittenValues& values,
                                       RobotOfModel& robot, const std::string& orientation);

}  // namespace regulus::verifier
