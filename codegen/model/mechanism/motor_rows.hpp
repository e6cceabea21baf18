// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of the matrix that motors drive: how many there are, whose they are, and their units.
#pragma once

#include <cstddef>
#include <string>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the number of motors. Of a closure they are the pose parameters; of other robots they have
/// the first rows of the matrix, and passive constraints the others.
[[nodiscard]] std::size_t motor_count(const Model& model);

/// Returns the name of a motor, by its row from 0: "leg 3", or the pose parameter of a closure.
[[nodiscard]] std::string motor_name(const Model& model, std::size_t row);

/// Returns the number of the leg of a motor, from 1.
[[nodiscard]] std::size_t leg_of_motor(const Model& model, std::size_t row);

/// True if the description of the robot says which motors turn, as [legs] does.
[[nodiscard]] bool knows_which_motors_turn(const Model& model);

/// Returns the unit of a motor's coordinate, such as "rad"; without one that is known, that of lengths.
[[nodiscard]] std::string unit_of_coordinate(const Model& model, std::size_t row);

/// Returns the unit of a motor's force; of one that turns it is that of a torque, where the model says
/// which motors turn.
[[nodiscard]] std::string unit_of_motor_force(const Model& model, std::size_t row);

}  // namespace regulus::detail
