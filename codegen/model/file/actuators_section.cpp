// SPDX-License-Identifier: GPL-3.0-or-later
// [actuators]: limits, errors and stiffness of the motors; characteristic_length.
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/file/sections.hpp"

namespace regulus::detail {
namespace {

ParsedExpression constant(ModelReading& reading, const TomlEntry& entry) {
  ParsedExpression term = reading.toml.constant(entry);
  append(reading.model.must_be_defined, term.must_be_defined);
  return term;
}

GiNaC::ex positive(ModelReading& reading, const TomlEntry& entry) {
  const GiNaC::ex value = constant(reading, entry).value;
  if (certain_sign(value) != CertainSign::kPositive)
    reading.toml.refuse(entry, "a positive number");
  return value;
}

/// The motors of a closure are its pose parameters, those of other robots the rows of the matrix.
struct Motors {
  explicit Motors(const Model& model)
      : count(model.closure ? model.pose.size() : model.matrix.rows()),
        one(model.closure ? "pose parameter" : "row") {}
  std::size_t count;
  std::string one;
};

/// Reads one number for every motor, or a list with one for each.
template <class Read>
auto by_motor(ModelReading& reading, const TomlEntry& entry, bool is_list, Read read) {
  const Motors motors(reading.model);
  std::vector<decltype(read(entry))> values;
  if (!is_list) {
    values.assign(motors.count, read(entry));
    return values;
  }
  const auto given = reading.toml.elements(entry, "a list with a value for each " + motors.one);
  if (given.size() != motors.count)
    reading.toml.refuse(
        entry, std::to_string(given.size()) + " values in " + entry.path,
        "one value, or " + std::to_string(motors.count) + ", one for each " + motors.one);
  for (const TomlEntry& e : given) values.push_back(read(e));
  return values;
}

Range range(ModelReading& reading, const TomlEntry& entry) {
  const auto ends = reading.toml.elements(entry, "a range [lower, upper]");
  if (ends.size() != 2)
    reading.toml.refuse(entry, std::to_string(ends.size()) + " numbers in " + entry.path,
                        "a range [lower, upper]");
  return checked_range(constant(reading, ends[0]), constant(reading, ends[1]),
                       reading.toml.place(entry));
}

bool is_list_of_ranges(const TomlEntry& entry) {
  const toml::array* list = entry.node->as_array();
  return list && !list->empty() && list->front().is_array();
}

}  // namespace

void read_actuators(ModelReading& reading, const TomlEntry& actuators) {
  static const std::array<std::string, 6> kKeys = {"unit",  "force_unit", "force",
                                                   "speed", "error",      "stiffness"};
  const TomlReader& toml = reading.toml;
  (void)toml.entries(actuators, kKeys);
  Actuators& read = reading.model.actuators;
  const auto values = [&](const char* key, auto& list, auto one) {
    if (const TomlEntry e = toml.optional(actuators, key); e.node)
      list = by_motor(reading, e, e.node->is_array(), one);
  };
  const auto limit = [&](const TomlEntry& e) { return positive(reading, e); };
  values("unit", read.units, [&](const TomlEntry& e) { return toml.label(e); });
  if (const TomlEntry e = toml.optional(actuators, "force_unit"); e.node)
    read.force_unit = toml.label(e);
  if (const TomlEntry e = toml.optional(actuators, "force"); e.node)
    read.force = by_motor(reading, e, is_list_of_ranges(e),
                          [&](const TomlEntry& one) { return range(reading, one); });
  values("speed", read.speed, limit);
  values("error", read.error, [&](const TomlEntry& e) {
    return checked_nonnegative(constant(reading, e), toml.place(e));
  });
  values("stiffness", read.stiffness, limit);
}

void read_characteristic_length(ModelReading& reading, const TomlEntry& length) {
  reading.model.characteristic_length = positive(reading, length);
}

}  // namespace regulus::detail
