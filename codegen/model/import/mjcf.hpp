// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/import/mechanism.hpp"
#include "codegen/model/import/xml_file.hpp"

namespace regulus::detail {

/// Reads the kinematics of an MJCF file, whose root element is <mujoco>: bodies, their joints, and
/// the loops that `equality` closes. Throws InputError with the line.
[[nodiscard]] Mechanism read_mjcf(const XmlElement& mujoco, NumberReader& numbers);

}  // namespace regulus::detail
