// SPDX-License-Identifier: GPL-3.0-or-later
// [pose] and [let]: the names that the matrix uses.
#include <algorithm>
#include <array>

#include "codegen/model/degrees.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {

void require_pose_name(const TomlReader& toml, const TomlEntry& entry, const std::string& name,
                       const std::string& what) {
  static const std::array<std::string, 9> kMotionKeys = {
      "parameters",    "constraints", "alpha", "error", "waypoints",
      "interpolation", "where",       "legs",  "tool"};
  if (std::ranges::find(kMotionKeys, name) != kMotionKeys.end())
    toml.reject(entry, what + " cannot be named '" + name + "', which is a key of motions",
                "choose another name");
}

PoseParameter read_parameter(ModelReading& reading, const TomlEntry& entry,
                             const std::string& what) {
  require_pose_name(reading.toml, entry, entry.key, what);
  const GiNaC::realsymbol symbol(entry.key);
  const std::string unit = reading.toml.label(entry);
  if (is_like_degrees(unit))
    reading.toml.reject(entry,
                        "the unit " + in_quotes(unit) + " of " + entry.path +
                            " is not known, and would be taken for a name of radians",
                        "write \"deg\"");
  reading.names.declare(entry.key,
                        is_in_degrees(unit) ? angle_in_degrees(symbol) : variable(symbol),
                        reading.toml.place(entry));
  return {symbol, entry.key, unit};
}

void read_pose(ModelReading& reading, const TomlEntry& pose) {
  for (const TomlEntry& entry : reading.toml.entries(pose))
    reading.model.pose.push_back(read_parameter(reading, entry));
  if (reading.model.pose.empty())
    reading.toml.refuse(pose, "an empty [pose]", "at least one pose parameter and its unit");
}

void read_let(ModelReading& reading, const TomlEntry& let) {
  const std::vector<TomlEntry> entries = reading.toml.entries(let);
  for (const TomlEntry& entry : entries) {
    if (entry.node->is_string())
      reading.names.declare_expression(entry.key, reading.toml.text(entry, "an expression"),
                                       reading.toml.place(entry));
    else
      reading.names.declare(entry.key, reading.toml.constant(entry), reading.toml.place(entry));
  }
  // An unused one is read as well: a mistake in it is a mistake in the file.
  for (const TomlEntry& entry : entries) (void)reading.names.find(entry.key, 0);
}

}  // namespace regulus::detail
