// SPDX-License-Identifier: GPL-3.0-or-later
// The stretches of a motion along way-points that is paved for a load, for programs and in a file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "codegen/answer/kinds.hpp"
#include "codegen/answer/lines_file.hpp"

namespace regulus::detail {

struct PathStretch;
struct Trajectory;

/// Returns the stretches with their JSON lines. `stretches`: their claims stand for those about forces.
[[nodiscard]] std::vector<StretchOfLoad> stretches_of_load(
    const Trajectory& trajectory, const std::vector<PathStretch>& stretches);

/// Writes a line for each stretch, and one with the summary, if they are wanted.
///
/// Throws    FileError.
void write_stretches(const std::vector<StretchOfLoad>& stretches,
                     const nlohmann::ordered_json& summary, LinesFile& lines);

}  // namespace regulus::detail
