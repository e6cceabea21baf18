// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/twist.hpp"

#include <algorithm>

#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/motor_rows.hpp"

namespace regulus::detail {
namespace {

bool is_angle(const PoseParameter& p) { return p.unit == "rad" || is_in_degrees(p.unit); }

/// True if all motors have coordinates in this unit. The motors of a closure move its pose parameters.
bool are_all_in(const Model& model, const std::string& unit) {
  if (!model.closure) {
    for (std::size_t i = 0; i < motor_count(model); ++i)
      if (unit_of_coordinate(model, i) != unit) return false;
    return true;
  }
  return std::ranges::all_of(
      model.pose, [&](const PoseParameter& p) { return (is_angle(p) ? "rad" : p.unit) == unit; });
}

/// Returns the unit of a force on the platform; "1" if it does not follow from that of the motors.
std::string force_unit_of(const Model& model) {
  const std::string &unit = model.actuators.force_unit, length = length_unit(model),
                    turned = " " + length;
  const bool has_torque_unit = unit.ends_with(turned);
  if (are_all_in(model, length)) return has_torque_unit ? "1" : unit;
  const bool all_turn = are_all_in(model, "rad"), has_legs = knows_which_motors_turn(model);
  if (has_torque_unit && (all_turn || has_legs)) return unit.substr(0, unit.size() - turned.size());
  // If motors turn and the model names no unit, its forces have the usual one.
  return has_legs && (!model.actuators.has_force_unit || !all_turn) ? unit : "1";
}

}  // namespace

std::string length_unit(const Model& model) {
  for (const auto& list :
       {model.pose, model.closure ? model.closure->unknowns : std::vector<PoseParameter>()})
    for (const PoseParameter& p : list)
      if (!is_angle(p)) return p.unit;
  return "1";
}

std::vector<TwistComponent> twist_of(const Model& model) {
  if (model.closure) {
    std::vector<TwistComponent> rates;
    for (const PoseParameter& p : model.closure->unknowns)
      rates.push_back({is_angle(p) ? TwistComponent::Kind::kAngular : TwistComponent::Kind::kLinear,
                       p.name, p.unit});
    return rates;
  }
  if (!model.twist.empty() || model.matrix.cols() != model.pose.size()) return model.twist;
  std::vector<TwistComponent> twist;
  for (const PoseParameter& p : model.pose)
    twist.push_back({is_angle(p) ? TwistComponent::Kind::kAngular : TwistComponent::Kind::kLinear,
                     p.name, is_angle(p) ? "rad" : p.unit});
  return twist;
}

std::vector<std::string> units_of_rates(const std::vector<TwistComponent>& twist) {
  std::vector<std::string> units;
  for (const TwistComponent& c : twist) units.push_back(c.unit + "/s");
  return units;
}

std::vector<std::string> units_of_wrench(const Model& model,
                                         const std::vector<TwistComponent>& twist) {
  const std::string force = force_unit_of(model);
  std::vector<std::string> units;
  for (const TwistComponent& c : twist)
    units.push_back(c.kind == TwistComponent::Kind::kAngular ? unit_of_work(model)
                    : c.unit == length_unit(model)           ? force
                                                             : "1");
  return units;
}

std::string unit_of_work(const Model& model) {
  const std::string force = force_unit_of(model), length = length_unit(model);
  if (force != "1" && length != "1") return force + " " + length;
  // Without lengths a torque of the motors tells it.
  const std::string& unit = model.actuators.force_unit;
  const bool is_torque =
      model.closure && are_all_in(model, "rad") && unit.find(' ') != std::string::npos;
  return is_torque ? unit : "1";
}

}  // namespace regulus::detail
