// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of a model file, one reader each.
#pragma once

#include <functional>
#include <vector>

#include "regulus/codegen/model/declarations.hpp"
#include "regulus/codegen/model/gough.hpp"
#include "regulus/codegen/model/model.hpp"
#include "regulus/codegen/model/toml_reader.hpp"

namespace regulus::codegen {

/// What the readers share.
struct ModelReading {
  TomlReader toml;
  Declarations names{};
  Model model{};
  std::vector<GiNaC::ex> motion_constraints{};  ///< that the robot itself puts on every motion
};

void read_pose(ModelReading& reading, const TomlEntry& pose);
void read_geometry(ModelReading& reading, const TomlEntry& geometry);
void read_let(ModelReading& reading, const TomlEntry& let);
void read_matrix(ModelReading& reading, const TomlEntry& matrix);

/// Fills pose, geometry, matrix and names from a [gough] table.
void read_gough(ModelReading& reading, const TomlEntry& gough);

void read_motions(ModelReading& reading, const TomlEntry& motions);

}  // namespace regulus::codegen
