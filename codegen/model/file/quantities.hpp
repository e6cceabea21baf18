// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths, coordinates and angles of a robot's parts, to which a tolerance of the file applies.
#pragma once

#include <string>

#include "codegen/model/file/sections.hpp"

namespace regulus::detail {

/// Reads a value that may use names of [geometry] and [let]. A name that stands for an exact
/// constant is its value: a number, a name for it, and an expression that equals it mean the same.
///
/// Ensures   a result that is not constant depends on uncertain constants, or on constants of a
///           group, and on nothing else. Conditions and size are added to the model's.
/// Throws    InputError for a value that depends on the pose, or has no value.
[[nodiscard]] ParsedExpression read_quantity(ModelReading& reading, const TomlEntry& entry,
                                             NumberUnit unit = NumberUnit::kPlain);

/// Reads an angle, and returns it in radians. Warns of one beyond a turn.
[[nodiscard]] ParsedExpression read_angle(ModelReading& reading, const TomlEntry& entry,
                                          bool in_degrees);

/// Returns the value with every constant of the geometry at its nominal value.
[[nodiscard]] GiNaC::ex nominal_value(const Model& model, const GiNaC::ex& value);

/// What a declared tolerance says of a quantity.
struct DeclaredTolerance {
  GiNaC::ex value = 0;
  std::string group;
  int ball = -1;  ///< as in GeometryParameter
};

/// Adds a parameter to the model's geometry that varies by the tolerance, independently of others,
/// and declares the name of the quantity.
///
/// Ensures   an exact quantity is the parameter `name`. One that depends on uncertain constants is
///           their expression plus a parameter NAME_error about 0, so that both variations count.
/// Returns   the quantity.
ParsedExpression declare_quantity(ModelReading& reading, const TomlEntry& entry,
                                  const std::string& name, const ParsedExpression& value,
                                  const DeclaredTolerance& tolerance);

/// Refuses a tolerance above 0 that no quantity of the file has: it would be dropped without a word.
void require_use(const TomlReader& toml, const TomlEntry& tolerance, const GiNaC::ex& value,
                 bool is_used, const std::string& quantities);

}  // namespace regulus::detail
