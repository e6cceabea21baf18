// SPDX-License-Identifier: GPL-3.0-or-later
// [gough]: a six-legged platform by its anchors.
#include <array>
#include <map>

#include "codegen/model/constants.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/names.hpp"

namespace regulus {
namespace {

Orientation orientation(const TomlReader& toml, const TomlEntry& entry) {
  return choice(toml, entry,
                std::array{std::pair{std::string("euler-zxz"), Orientation::kEulerZxz},
                           std::pair{std::string("roll-pitch-yaw"), Orientation::kRollPitchYaw},
                           std::pair{std::string("quaternion"), Orientation::kQuaternion}});
}

ToleranceShape tolerance_shape(const TomlReader& toml, const TomlEntry& entry) {
  return choice(toml, entry,
                std::array{std::pair{std::string("box"), ToleranceShape::kBox},
                           std::pair{std::string("ball"), ToleranceShape::kBall}});
}

std::string angle_unit(const TomlReader& toml, const TomlEntry& entry, Orientation orientation) {
  if (orientation == Orientation::kQuaternion)
    toml.reject(entry, "a quaternion has no angles", "remove angle_unit");
  return choice(toml, entry,
                std::array{std::pair{std::string("rad"), std::string("rad")},
                           std::pair{std::string("deg"), std::string("deg")}});
}

ParsedExpression constant(ModelReading& reading, const TomlEntry& entry,
                          std::vector<GiNaC::ex>& conditions) {
  ParsedExpression term = reading.toml.constant(entry);
  append(conditions, term.must_be_defined);
  return term;
}

std::array<Point, 6> anchors(ModelReading& reading, const TomlEntry& entry,
                             std::vector<GiNaC::ex>& conditions) {
  const std::string expected = "6 points of 3 coordinates";
  const auto points = reading.toml.elements(entry, expected);
  if (points.size() != 6)
    reading.toml.refuse(entry, std::to_string(points.size()) + " points in " + entry.path,
                        expected);
  std::array<Point, 6> result;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto coordinates = reading.toml.elements(points[i], expected);
    if (coordinates.size() != 3)
      reading.toml.refuse(
          points[i], std::to_string(coordinates.size()) + " coordinates in " + points[i].path, "3");
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[i][axis] = constant(reading, coordinates[axis], conditions).value;
  }
  return result;
}

GiNaC::ex tolerance(ModelReading& reading, const TomlEntry& entry,
                    std::vector<GiNaC::ex>& conditions) {
  if (!entry.node) return 0;
  return checked_nonnegative(constant(reading, entry, conditions), reading.toml.place(entry));
}

void declare_symbols(ModelReading& reading, const TomlEntry& gough) {
  const Place place = reading.toml.place(gough);
  for (const PoseParameter& p : reading.model.pose)
    reading.names.declare(
        p.name, is_in_degrees(p.unit) ? angle_in_degrees(p.symbol) : variable(p.symbol), place);
  for (const GeometryParameter& g : reading.model.geometry)
    reading.names.declare(g.name, variable(g.symbol), place);
}

}  // namespace

void read_gough(ModelReading& reading, const TomlEntry& gough) {
  static const std::array<std::string, 8> kKeys = {
      "angle_unit", "unit",           "orientation",        "base",
      "platform",   "base_tolerance", "platform_tolerance", "tolerance_shape"};
  const TomlReader& toml = reading.toml;
  (void)toml.entries(gough, kKeys);

  std::vector<GiNaC::ex> conditions;
  Gough robot{.name = reading.model.name, .source = reading.model.source};
  if (const TomlEntry unit = toml.optional(gough, "unit"); unit.node) robot.unit = toml.label(unit);
  robot.orientation = orientation(toml, toml.required(gough, "orientation"));
  if (const TomlEntry unit = toml.optional(gough, "angle_unit"); unit.node)
    robot.angle_unit = angle_unit(toml, unit, robot.orientation);
  robot.base = anchors(reading, toml.required(gough, "base"), conditions);
  robot.platform = anchors(reading, toml.required(gough, "platform"), conditions);
  robot.base_tolerance = tolerance(reading, toml.optional(gough, "base_tolerance"), conditions);
  robot.platform_tolerance =
      tolerance(reading, toml.optional(gough, "platform_tolerance"), conditions);
  if (const TomlEntry shape = toml.optional(gough, "tolerance_shape"); shape.node)
    robot.tolerance_shape = tolerance_shape(toml, shape);

  reading.model = gough_model(robot);
  append(reading.model.must_be_defined, conditions);
  declare_symbols(reading, gough);
}

}  // namespace regulus
