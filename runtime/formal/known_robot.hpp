// SPDX-License-Identifier: Apache-2.0
// Which robots of model files have a theorem, and which keys of theirs it knows.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/model/section_reading.hpp"

namespace regulus::verifier {

enum class RobotKind {
  kPlatform,  ///< [gough], or [legs] with legs of variable length alone
  kArm,       ///< [serial]
  kLegs,      ///< other ones of [legs]
  kMatrix,    ///< [matrix]
};

/// Returns the first table that the file has. Throws Unfinished if there is no theorem about it.
[[nodiscard]] RobotKind kind_of_robot(const WrittenValues& values);

/// Returns the pose parameters in their order: those of the section, or of [pose].
[[nodiscard]] std::vector<SectionPose> poses_of_file(const WrittenValues& values);

/// Throws Unfinished for a second robot, a motion that the file does not have, and a key without a
/// meaning in a theorem.
void require_known_robot(const WrittenValues& values, RobotKind kind, const std::string& motion);

}  // namespace regulus::verifier
