// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/motor_rows.hpp"

#include <algorithm>

#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {
namespace {

/// Returns the unit of each motor's coordinate; empty if the model does not say.
std::vector<std::string> known_units(const Model& model) {
  if (!model.actuators.units.empty()) return model.actuators.units;
  std::vector<std::string> units;
  if (model.motors)
    for (const MotorRow& motor : *model.motors) units.push_back(motor.unit);
  return units;
}

}  // namespace

std::size_t motor_count(const Model& model) {
  if (model.closure) return model.pose.size();
  return model.motors ? model.motors->size() : model.matrix.rows();
}

bool knows_which_motors_turn(const Model& model) {
  return model.motors && std::ranges::none_of(*model.motors, &std::string::empty, &MotorRow::unit);
}

std::size_t leg_of_motor(const Model& model, std::size_t row) {
  return model.motors && row < model.motors->size() ? (*model.motors)[row].leg : row + 1;
}

std::string motor_name(const Model& model, std::size_t row) {
  if (model.closure) return model.pose[row].name;
  return "leg " + std::to_string(leg_of_motor(model, row));
}

std::string unit_of_coordinate(const Model& model, std::size_t row) {
  const std::vector<std::string> units = known_units(model);
  const bool is_known = row < units.size() && !units[row].empty();
  return is_known ? units[row] : length_unit(model);
}

std::string unit_of_motor_force(const Model& model, std::size_t row) {
  const std::string &unit = model.actuators.force_unit, length = length_unit(model),
                    turned = " " + length;
  const std::vector<std::string> units = known_units(model);
  if (model.closure || units.empty()) return unit;
  const auto turns = [](const std::string& u) { return u == "rad"; };
  const bool all_turn = std::ranges::all_of(units, turns);
  if (std::ranges::none_of(units, turns) || (all_turn && model.actuators.has_force_unit))
    return unit;
  const std::string force =
      unit.ends_with(turned) ? unit.substr(0, unit.size() - turned.size()) : unit;
  if (row >= units.size() || !turns(units[row])) return force;
  return length == "1" ? "1" : force + turned;
}

}  // namespace regulus::detail
