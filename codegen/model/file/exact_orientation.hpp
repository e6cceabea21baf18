// SPDX-License-Identifier: GPL-3.0-or-later
// Axes and orientations of exact numbers in a model file.
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/file/sections.hpp"

namespace regulus::detail {

/// Returns the elements of a list; refuses one of another length.
[[nodiscard]] std::vector<TomlEntry> elements_of(const TomlReader& toml, const TomlEntry& list,
                                                 std::size_t count);

/// Reads a direction of any length, and returns it with length 1.
[[nodiscard]] Point read_unit_vector(ModelReading& reading, const TomlEntry& list);

/// Reads w x y z, of any length, and returns the rotation.
[[nodiscard]] GiNaC::matrix read_quaternion(ModelReading& reading, const TomlEntry& list);

/// Reads three rows that are proved to be a rotation.
[[nodiscard]] GiNaC::matrix read_rotation(ModelReading& reading, const TomlEntry& list);

}  // namespace regulus::detail
