// SPDX-License-Identifier: GPL-3.0-or-later
// Robots in the plane whose legs close loops: platforms on three legs, and five-bars.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/body_graph.hpp"

namespace regulus::detail {

/// A point in the plane of the robot, every joint at zero.
using PlanePoint = std::array<GiNaC::ex, 2>;

/// A leg of [legs]: its joints, from the base, are of the kinds of its type.
struct PlanarLeg {
  std::string type;                ///< "RRR", "RPR" or "PRR"
  std::vector<std::string> names;  ///< of its joints; a joint of a loop has the loop's type
  PlanePoint base, elbow, end;     ///< of an RPR leg: no elbow
  PlanePoint slide;                ///< the direction of a joint that slides
  int actuated = 1;                ///< number of the driven joint
};

struct PlanarRobot {
  std::string base, platform;  ///< links; no platform: all legs end in one point
  std::string plane;           ///< "xy", "yz" or "zx" of the world
  std::vector<PlanarLeg> legs;
  PlanePoint home;  ///< of the platform's origin, or of the point
};

/// Returns the robot if the mechanism has loops and moves in a coordinate plane: two bodies and three
/// legs of three joints between them, or one loop of five joints.
///
/// `base`: a link of the fixed body; empty: the world or the root. `actuated`: names of driven
/// joints, at most one of each leg; the other legs have the usual one.
/// Throws    InputError for such legs of other types; UsageError for `actuated`.
[[nodiscard]] std::optional<PlanarRobot> find_planar_robot(
    const Mechanism& mechanism, const std::string& file, const std::string& base,
    const std::vector<std::string>& actuated);

/// Returns the tables [legs], [motion.home] and [motion.around_home] of a model file.
[[nodiscard]] std::string planar_text(const PlanarRobot& robot, std::vector<std::string>& notes);

}  // namespace regulus::detail
