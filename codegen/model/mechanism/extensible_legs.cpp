// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/extensible_legs.hpp"

#include <algorithm>

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {

std::vector<ExtensibleLeg> extensible_legs(const Legs& robot,
                                           const std::function<GiNaC::ex(const Formula&)>& value) {
  const auto is_extensible = [](const Leg& leg) {
    return leg.type->kind == LegKind::kTelescopic && leg.actuated == 2 && !leg.type->is_hinged &&
           !leg.type->keeps_orientation;
  };
  if (robot.point || robot.legs.size() != (robot.planar ? 3U : 6U) ||
      !std::ranges::all_of(robot.legs, is_extensible))
    return {};
  std::vector<ExtensibleLeg> legs;
  for (std::size_t i = 0; i < robot.legs.size(); ++i) {
    ExtensibleLeg& leg = legs.emplace_back();
    for (std::size_t axis = 0; axis < (robot.planar ? 2U : 3U); ++axis) {
      std::string e(1, 'e');
      e.append(std::to_string(i + 1)).append(1, '_').append(kCoordinates[axis]);
      leg.base[axis] = value(robot.legs[i].base[axis]);
      leg.platform[axis] = value(robot.legs[i].platform[axis]);
      leg.vector[axis] = value(unplaced(e));
    }
  }
  return legs;
}

}  // namespace regulus::detail
