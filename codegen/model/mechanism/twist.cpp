// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/twist.hpp"

#include "codegen/model/degrees.hpp"

namespace regulus {
namespace {

bool is_angle(const PoseParameter& p) { return p.unit == "rad" || is_in_degrees(p.unit); }

}  // namespace

std::string length_unit(const Model& model) {
  for (const PoseParameter& p : model.pose)
    if (!is_angle(p)) return p.unit;
  return "1";
}

std::vector<TwistComponent> twist_of(const Model& model) {
  if (!model.twist.empty() || model.matrix.cols() != model.pose.size()) return model.twist;
  std::vector<TwistComponent> twist;
  for (const PoseParameter& p : model.pose)
    twist.push_back({is_angle(p) ? TwistComponent::Kind::kAngular : TwistComponent::Kind::kLinear,
                     p.name, is_angle(p) ? "rad" : p.unit});
  return twist;
}

}  // namespace regulus
