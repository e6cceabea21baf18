// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/turning_tool.hpp"

#include <algorithm>
#include <memory>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_direction.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr std::size_t kJointsOfPlace = 5;

/// The names of the joints that are free.
std::vector<std::string> free_joints(const Request& request, const std::vector<std::string>& held) {
  std::vector<std::string> free;
  for (std::size_t k = 0; k < request.model.pose.size(); ++k) {
    const std::string& name = request.model.pose[k].name;
    const bool is_held = std::ranges::find(held, name) != held.end();
    if (!is_held && !keeps_value(request.model, request.motion, k)) free.push_back(name);
  }
  return free;
}

/// Seen from the last joint.
bool is_axis_of_last(const Model& model) {
  const SerialJoint& last = model.arm->joints.back();
  if (last.kind != JointKind::kRevolute) return false;
  const NominalGeometry nominal(model);
  Point axis, z, place;
  for (unsigned i = 0; i < 3; ++i) {
    axis[i] = nominal.at(last.axis[i]);
    z[i] = nominal.at(model.arm->tool.R(i, 2));
    place[i] = nominal.at(model.arm->tool.p[i]);
  }
  for (const auto& across : {cross(axis, z), cross(axis, place)})
    for (const ex& part : across)
      if (certain_sign(part.expand()) != CertainSign::kZero) return false;
  return true;
}

std::string name_of_turn(const Model& model) {
  std::string name = "turn";
  while (std::ranges::find(model.pose, name, &PoseParameter::name) != model.pose.end())
    name = "tool_" + name;
  return name;
}

}  // namespace

void let_tool_turn(Request& request, const std::vector<std::string>& held) {
  Model& model = request.model;
  Motion& motion = request.motion;
  if (!model.arm) return;
  const std::vector<std::string> free = free_joints(request, held);
  if (free.size() != kJointsOfPlace || direction_of(model, ArmGeometry::kNominal)) return;
  const bool is_last_free = std::ranges::find(free, model.arm->joints.back().name) != free.end();
  if (is_last_free && is_axis_of_last(model))
    throw UsageError(
        "5 joints are free to move, and the last one turns about the z axis of the tool: place and "
        "direction of this "
        "axis are the same for all of its values; give the arm a tool with another z axis, or "
        "postures of six joints");
  Serial arm = *model.arm;
  const std::string name = name_of_turn(model);
  const PoseParameter turn{GiNaC::realsymbol(name), name, arm.angle_unit, true};
  arm.joints.push_back({name, JointKind::kRevolute, arm.tool, {0, 0, 1}});
  arm.tool = {};
  model.arm = std::make_shared<const Serial>(std::move(arm));
  model.pose.push_back(turn);
  if (!model.limits.empty()) {
    const ex half = is_in_degrees(turn.unit) ? ex(180) : ex(GiNaC::Pi);
    model.limits.push_back({-half, half});
  }
  motion.pose.push_back(motion.tool.empty() ? ex(0) : ex(turn.symbol));
  motion.error.emplace_back(0);
  request.notes.push_back("5 joints bring the tool to a place and its z axis to a direction; " +
                          name +
                          " is the angle by which it is turned about this axis then, up to the "
                          "orientation that is given");
}

bool is_turn_of_tool(const Model& model, std::size_t pose) {
  return model.arm != nullptr && model.pose[pose].is_deviation;
}

}  // namespace regulus::detail
