// SPDX-License-Identifier: GPL-3.0-or-later
// Arms that turn about one direction: SCARA robots, and palletizing arms whose parallelograms keep the tool level.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codegen/question/solve/arm_chain.hpp"

namespace regulus::detail {

/// A direction in exact numbers, seen from the base and from the frame that the last joint moves. All angular velocities
/// of this frame are along it at all postures, so each of its orientations is one of them turned about it.
struct ArmDirection {
  std::array<GiNaC::ex, 3> of_base, of_end;
};

/// Returns the direction of such an arm; nullopt: exact algebra does not show that there is one, and that it is the same
/// for all values of the geometry.
///
/// Requires  model.arm.
[[nodiscard]] std::optional<ArmDirection> direction_of(const Model& model, ArmGeometry geometry);

/// Says whether the orientation of a place of the tool is one of the arm.
enum class IsTurnedTo : std::uint8_t { kYes, kNo, kUnknown };
[[nodiscard]] IsTurnedTo is_turned_to(const ArmDirection& direction, const Model& model,
                                      ArmGeometry geometry, const std::vector<GiNaC::ex>& tool);

}  // namespace regulus::detail
