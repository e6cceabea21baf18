// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/model/way/trajectory.hpp"

namespace regulus::detail {

/// Returns the way-points for a page: `file`, `sha256`, `interpolation`, `time_unit` (null without
/// times), and for each piece `lines`, [first, last] of the file, and `times`, [begin, end],
/// approximate.
[[nodiscard]] nlohmann::ordered_json json_way(const Trajectory& trajectory);

}  // namespace regulus::detail
