// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/legs_drawing.hpp"

namespace regulus::detail {
namespace {

using Kind = Drawing::Kind;

/// The parts of one leg; its rod, or the leg itself, belongs to the row of its motor.
void add_leg(const LegPoints& leg, const std::vector<Point>& points,
             std::vector<Drawing::Part>& parts) {
  if (leg.kind == LegKind::kTelescopic) {
    parts.push_back({Kind::kLeg, points, leg.row});
    return;
  }
  parts.push_back(
      {leg.kind == LegKind::kCrank ? Kind::kLink : Kind::kRail, {points[0], points[1]}});
  parts.push_back({Kind::kLink, {points[1], points[2]}, leg.row});
}

}  // namespace

Drawing legs_drawing(const std::vector<LegPoints>& legs,
                     const std::function<GiNaC::ex(const Formula&)>& value) {
  Drawing::Part base{Kind::kBase, {}}, platform{Kind::kPlatform, {}};
  std::vector<Drawing::Part> parts;
  for (const LegPoints& leg : legs) {
    std::vector<Point> points;
    for (const FormulaPoint& p : leg.points)
      points.push_back({value(p[0]), value(p[1]), value(p[2])});
    base.points.push_back(points.front());
    platform.points.push_back(points.back());
    add_leg(leg, points, parts);
  }
  parts.insert(parts.begin(), {base, platform});
  return {std::move(parts)};
}

}  // namespace regulus::detail
