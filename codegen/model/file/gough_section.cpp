// SPDX-License-Identifier: GPL-3.0-or-later
// [gough]: a six-legged platform by its anchors.
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/file/leg_geometry.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/gough.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

Orientation orientation(const TomlReader& toml, const TomlEntry& entry) {
  return choice(toml, entry,
                std::array{std::pair{std::string("euler-zxz"), Orientation::kEulerZxz},
                           std::pair{std::string("roll-pitch-yaw"), Orientation::kRollPitchYaw},
                           std::pair{std::string("quaternion"), Orientation::kQuaternion}});
}

std::string angle_unit(const TomlReader& toml, const TomlEntry& entry, Orientation orientation) {
  if (orientation == Orientation::kQuaternion)
    toml.reject(entry, "a quaternion has no angles", "remove angle_unit");
  return choice(toml, entry,
                std::array{std::pair{std::string("rad"), std::string("rad")},
                           std::pair{std::string("deg"), std::string("deg")}});
}

void declare_pose(ModelReading& reading, const TomlEntry& gough) {
  const Place place = reading.toml.place(gough);
  for (const PoseParameter& p : reading.model.pose)
    reading.names.declare(
        p.name, is_in_degrees(p.unit) ? angle_in_degrees(p.symbol) : variable(p.symbol), place);
}

std::array<Point, 6> anchors(ModelReading& reading, LegGeometry& geometry, const TomlEntry& entry,
                             LegGroup group) {
  const std::string expected = "6 points of 3 coordinates";
  const auto points = reading.toml.elements(entry, expected);
  if (points.size() != 6)
    reading.toml.refuse(entry, std::to_string(points.size()) + " points in " + entry.path,
                        expected);
  std::array<Point, 6> result;
  for (std::size_t i = 0; i < 6; ++i) {
    const FormulaPoint names = geometry.point(points[i], group, std::to_string(i + 1));
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[i][axis] = reading.names.find(names[axis].text(), 0)->value;
  }
  return result;
}

}  // namespace

void read_gough(ModelReading& reading, const TomlEntry& gough) {
  static const std::array<std::string, 8> kKeys = {
      "angle_unit", "unit",           "orientation",        "base",
      "platform",   "base_tolerance", "platform_tolerance", "tolerance_shape"};
  const TomlReader& toml = reading.toml;
  (void)toml.entries(gough, kKeys);

  Gough robot;
  if (const TomlEntry unit = toml.optional(gough, "unit"); unit.node) robot.unit = toml.label(unit);
  robot.orientation = orientation(toml, toml.required(gough, "orientation"));
  if (const TomlEntry unit = toml.optional(gough, "angle_unit"); unit.node)
    robot.angle_unit = angle_unit(toml, unit, robot.orientation);
  add_pose_of_gough(reading.model, robot);
  declare_pose(reading, gough);
  LegGeometry geometry(reading, gough);
  geometry.read_tolerances();
  robot.base = anchors(reading, geometry, toml.required(gough, "base"), LegGroup::kBase);
  robot.platform =
      anchors(reading, geometry, toml.required(gough, "platform"), LegGroup::kPlatform);
  geometry.require_uses();
  add_matrix_of_gough(reading.model, robot);
  reading.model.drawing =
      std::make_shared<Drawing>(geometry.labelled(*reading.model.drawing, robot.unit));
}

}  // namespace regulus::detail
