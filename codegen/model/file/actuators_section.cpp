// SPDX-License-Identifier: GPL-3.0-or-later
// [actuators]: limits, errors and stiffness of the motors; characteristic_length.
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/motor_rows.hpp"

namespace regulus::detail {
namespace {

ParsedExpression constant(ModelReading& reading, const TomlEntry& entry,
                          NumberUnit unit = NumberUnit::kPlain) {
  ParsedExpression term = reading.toml.constant(entry, unit);
  append(reading.model.must_be_defined, term.must_be_defined);
  return term;
}

GiNaC::ex positive(ModelReading& reading, const TomlEntry& entry,
                   NumberUnit unit = NumberUnit::kPlain) {
  const GiNaC::ex value = constant(reading, entry, unit).value;
  if (certain_sign(value) != CertainSign::kPositive)
    reading.toml.refuse(entry, "a positive number");
  return value;
}

/// The motors of a closure are its pose parameters, those of other robots have the first rows of the
/// matrix. Passive constraints have the others.
struct Motors {
  explicit Motors(const Model& model)
      : count(motor_count(model)),
        rows(model.closure ? count : std::size_t(model.matrix.rows())),
        one(model.closure   ? "pose parameter"
            : rows == count ? "row"
                            : "motor") {}
  std::size_t count, rows;
  std::string one;
};

/// Reads one number for every motor, or a list with one for each; a list with one for each row of the
/// matrix is about the constraints, too. `read` takes an entry and the number of its row.
template <class Read>
auto by_motor(ModelReading& reading, const TomlEntry& entry, bool is_list, Read read) {
  const Motors motors(reading.model);
  std::vector<decltype(read(entry, 0))> values;
  if (!is_list) {
    for (std::size_t i = 0; i < motors.count; ++i) values.push_back(read(entry, i));
    return values;
  }
  const auto given = reading.toml.elements(entry, "a list with a value for each " + motors.one);
  if (given.size() != motors.count && given.size() != motors.rows)
    reading.toml.refuse(
        entry, std::to_string(given.size()) + " values in " + entry.path,
        "one value, or " + std::to_string(motors.count) + ", one for each " + motors.one +
            (motors.rows == motors.count
                 ? ""
                 : ", or " + std::to_string(motors.rows) + ", one for each row of the matrix"));
  for (std::size_t i = 0; i < given.size(); ++i) values.push_back(read(given[i], i));
  return values;
}

/// The coordinate of a motor of a closure is a number of degrees, if that is the unit of its pose
/// parameter; all others are lengths and radians.
NumberUnit unit_of_numbers(const Model& model, std::size_t motor) {
  return model.closure ? number_unit(model.pose[motor].unit) : NumberUnit::kPlain;
}

/// Refuses a unit that the numbers of a motor do not have.
std::string unit_of_motor(ModelReading& reading, const TomlEntry& entry, std::size_t motor) {
  const Model& model = reading.model;
  const std::string unit = reading.toml.label(entry);
  if (motor >= motor_count(model)) return unit;
  const std::string whose = motor_name(model, motor);
  if (model.closure && unit != model.pose[motor].unit)
    reading.toml.reject(entry,
                        "the motor " + in_quotes(whose) + " has the unit " +
                            in_quotes(model.pose[motor].unit) + " of its pose parameter, not " +
                            in_quotes(unit),
                        "remove [actuators] unit");
  if (model.closure) return unit;
  if (is_in_degrees(unit) || is_like_degrees(unit))
    reading.toml.reject(entry, "the coordinates of motors that turn are in radians here",
                        "write \"rad\", and numbers of degrees as \"0.1deg\"");
  const std::string known = model.motors ? (*model.motors)[motor].unit : "";
  const bool is_named = !known.empty() && known != "1";
  if (is_named && unit != known)
    reading.toml.reject(
        entry,
        "the motor of " + whose + (known == "rad" ? " turns" : " moves along a length") +
            ", and its coordinate has the unit " + in_quotes(known) + ", not " + in_quotes(unit),
        "write " + in_quotes(known) + ", or remove [actuators] unit");
  return unit;
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
  const auto unit_of = [&](std::size_t motor) { return unit_of_numbers(reading.model, motor); };
  values("unit", read.units,
         [&](const TomlEntry& e, std::size_t motor) { return unit_of_motor(reading, e, motor); });
  if (const TomlEntry e = toml.optional(actuators, "force_unit"); e.node) {
    read.force_unit = toml.label(e);
    read.has_force_unit = true;
  }
  if (const TomlEntry e = toml.optional(actuators, "force"); e.node)
    read.force = by_motor(reading, e, is_list_of_ranges(e),
                          [&](const TomlEntry& one, std::size_t) { return range(reading, one); });
  values("speed", read.speed, [&](const TomlEntry& e, std::size_t motor) {
    return positive(reading, e, unit_of(motor));
  });
  values("error", read.error, [&](const TomlEntry& e, std::size_t motor) {
    return checked_nonnegative(constant(reading, e, unit_of(motor)), toml.place(e));
  });
  values("stiffness", read.stiffness,
         [&](const TomlEntry& e, std::size_t) { return positive(reading, e); });
}

void read_characteristic_length(ModelReading& reading, const TomlEntry& length) {
  reading.model.characteristic_length = positive(reading, length);
}

}  // namespace regulus::detail
