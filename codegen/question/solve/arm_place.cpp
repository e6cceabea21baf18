// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_system.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kSearchedJoints = 4;

/// Returns the joints of the option, and those to which a motion by the tool gives a value.
std::vector<std::string> held_joints(const Model& model, const Motion& motion,
                                     std::vector<std::string> names) {
  for (std::size_t i = 0; i < model.pose.size() && !motion.tool.empty(); ++i) {
    const std::string& name = model.pose[i].name;
    const bool is_named = std::ranges::find(names, name) != names.end();
    if (is_named && !keeps_value(model, motion, i))
      throw UsageError(fmt::format(
          "{} is held, and has no value; give it beside the place of the tool, at {}=VALUE",
          in_quotes(name), name));
    if (!is_named && keeps_value(model, motion, i)) names.push_back(name);
  }
  return names;
}

/// Makes a joint a part of the link behind it.
void hold(ArmAtPlace& arm, const Model& model, const std::string& name,
          const std::vector<Interval>& values) {
  const auto at =
      std::ranges::find(arm.free, name, [&model](std::size_t i) { return model.pose[i].name; });
  if (at == arm.free.end()) throw UsageError("no joint " + in_quotes(name) + " is free to be held");
  const auto k = std::size_t(at - arm.free.begin());
  const LinkFrame link = compose(arm.chain[k].origin, arm.chain[k].moved(values[*at]));
  if (k + 1 < arm.chain.size())
    arm.chain[k + 1].origin = compose(link, arm.chain[k + 1].origin);
  else
    arm.target = compose(arm.target, inverse(link));
  arm.chain.erase(arm.chain.begin() + std::ptrdiff_t(k));
  arm.free.erase(at);
}

void require_six_joints(const ArmAtPlace& arm, const Request& request) {
  if (arm.chain.size() == kJoints) return;
  throw UsageError(fmt::format(
      "{} joints are free to move, and a frame fixes six; {}", arm.chain.size(),
      arm.chain.size() < kJoints ? "postures are found of arms with six"
      : !request.motion.tool.empty()
          ? "give values that some keep, such as at " + request.model.pose.back().name + "=VALUE"
          : "name some that keep their values by hold"));
}

}  // namespace

ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const Model& model = request.model;
  for (const SerialJoint& joint : model.arm->joints)
    if (joint.follows)
      throw UsageError("the postures of an arm with joints that follow others are not found");
  ArmAtPlace arm;
  arm.geometry = has_tolerances(request) && !has_errors(request.motion)
                     ? ArmGeometry::kWithinTolerances
                     : ArmGeometry::kNominal;
  arm.chain = enclose_chain(model, arm.geometry);
  const std::vector<std::string> names = held_joints(model, request.motion, held);
  const std::vector<Interval> values = enclose_values(model, request.motion);
  arm.free.resize(arm.chain.size());
  std::iota(arm.free.begin(), arm.free.end(), std::size_t{0});
  arm.target = request.motion.tool.empty()
                   ? posture_at(enclose_chain(model, ArmGeometry::kNominal), values).end
                   : enclose_target(model, request.motion.tool, arm.geometry);
  for (const std::string& name : names) hold(arm, model, name, values);
  require_six_joints(arm, request);
  return arm;
}

std::vector<std::size_t> opposite_systems(const ArmChain& chain) {
  const auto sliding = std::ranges::count(chain, false, &ArmJoint::turns);
  if (sliding > 1) return {};
  if (sliding == 0) return {0, 1, 2};
  const auto slide = std::ranges::find(chain, false, &ArmJoint::turns) - chain.begin();
  return {(std::size_t(slide) + kJoints - 2) % kJoints};  // it is the third joint of the loop
}

std::pair<ArmChain, LinkFrame> loop_from(const ArmAtPlace& arm, std::size_t number) {
  auto loop = rotated_loop(arm.chain, arm.target, number);
  move_origins(loop.first, loop.second);
  return loop;
}

RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number) {
  if (number == kWholeArm) {
    const auto whole = std::make_shared<const ArmAtPlace>(arm);
    return {number, kJoints,
            [whole] { return std::make_unique<WholeArm>(whole->chain, whole->target); }};
  }
  const auto loop = std::make_shared<const std::pair<ArmChain, LinkFrame>>(loop_from(arm, number));
  return {number, kSearchedJoints,
          [loop] { return std::make_unique<OppositeAxes>(loop->first, loop->second); }};
}

}  // namespace regulus::detail
