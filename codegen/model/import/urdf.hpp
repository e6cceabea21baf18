// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/import/mechanism.hpp"
#include "codegen/model/import/xml_file.hpp"

namespace regulus::detail {

/// Reads the kinematics of a URDF file, whose root element is <robot>. Lengths are in m, angles in
/// rad. Throws InputError with the line.
[[nodiscard]] Mechanism read_urdf(const XmlElement& robot, NumberReader& numbers);

}  // namespace regulus::detail
