// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/rank_roots.hpp"

#include <algorithm>
#include <memory>

#include "codegen/question/solve/arm_place.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/platform_poses.hpp"
#include "codegen/question/solve/pose_search.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

RootSystems systems_of_platform(const Request& request, std::size_t number) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const GoughLegs legs = enclose_legs(request);
  if (number < kChartsOfRotations) {
    auto equations = std::make_shared<const PoseEquations>(legs);
    return equations->exist() ? systems_of_chart(std::move(equations), int(number)) : RootSystems();
  }
  auto equations = std::make_shared<const FollowedEquations>(legs, enclose_uncertain_legs(request));
  const bool exist = equations->first.exist() && equations->all.exist();
  return exist ? systems_of_chart(std::move(equations), int(number) - kChartsOfRotations)
               : RootSystems();
}

}  // namespace

std::optional<Request> kernel_request(const Request& request) {
  if (request.model.legs.size() == 3) return planar_request(request);
  return request.model.closure ? std::optional(request) : std::nullopt;
}

RootSystems systems_of(const Request& request, const std::vector<std::string>& held,
                       std::size_t number) {
  if (!request.model.arm)
    return number < 2 * kChartsOfRotations ? systems_of_platform(request, number) : RootSystems();
  const bool is_nominal = kNominalArm <= number && number < kFollowedArm;
  const ArmAtPlace arm =
      is_nominal ? nominal_arm_at_place(request, held) : arm_at_place(request, held);
  const std::size_t own = number % kNominalArm;
  const std::vector<std::size_t> without_two = systems_without_two(arm);
  if (own != kWholeArm && std::ranges::find(without_two, own) == without_two.end())
    return RootSystems();
  RootSystems systems =
      number < kFollowedArm ? systems_of_arm(arm, own) : followed_systems_of_arm(arm, own);
  systems.number = number;
  return systems;
}

}  // namespace regulus::detail
