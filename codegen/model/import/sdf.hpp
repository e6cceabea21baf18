// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/import/mechanism.hpp"
#include "codegen/model/import/xml_file.hpp"

namespace regulus::detail {

/// Reads the kinematics of the first model of an SDF file, whose root element is <sdf>. All frames
/// are resolved exactly. Throws InputError with the line.
[[nodiscard]] Mechanism read_sdf(const XmlElement& sdf, NumberReader& numbers);

}  // namespace regulus::detail
