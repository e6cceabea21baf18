// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of a robot for pictures, as points in the pose and geometry symbols of its model.
// Nothing that is proved depends on it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {

struct Drawing {
  enum class Kind {
    kBase,      ///< a closed polygon that does not move
    kPlatform,  ///< a closed polygon that moves
    kLeg,       ///< a rod that changes its length
    kLink,      ///< a body of constant length
    kRail,      ///< the way of a slider
    kJoint,  ///< two points: the place of a joint, and that place plus the unit vector of its axis
    kTool,  ///< four points: the place of a tool, and that place plus each unit vector of its frame
  };
  struct Part {
    Kind kind = Kind::kLeg;
    std::vector<Point> points;
    int row = -1;  ///< of the matrix, from 0, that the part belongs to; −1: none
  };
  std::vector<Part> parts;
  /// Labels of the units of the constants that are lengths, by name.
  std::map<std::string, std::string> units{};
};

/// Returns the label of a constant's unit; "1" if there is none, or it is not known.
[[nodiscard]] inline std::string unit_of_constant(const Drawing* drawing, const std::string& name) {
  if (drawing == nullptr) return "1";
  const auto at = drawing->units.find(name);
  return at == drawing->units.end() ? "1" : at->second;
}

/// Returns the word of a page's data for the kind.
[[nodiscard]] constexpr const char* name(Drawing::Kind kind) noexcept {
  switch (kind) {
    case Drawing::Kind::kBase:
      return "base";
    case Drawing::Kind::kPlatform:
      return "platform";
    case Drawing::Kind::kLeg:
      return "leg";
    case Drawing::Kind::kLink:
      return "link";
    case Drawing::Kind::kRail:
      return "rail";
    case Drawing::Kind::kJoint:
      return "joint";
    case Drawing::Kind::kTool:
      return "tool";
  }
  return "";
}

}  // namespace regulus::detail
