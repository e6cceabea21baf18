// SPDX-License-Identifier: GPL-3.0-or-later
// Running a search of a preparation, with more digits and exact algebra at hand.
#pragma once

#include <span>
#include <vector>

#include "codegen/engine/pipeline.hpp"
#include "runtime/checkpoint/checkpoint.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::inline engine {

/// The seconds of a time limit that the stages before the search have left.
[[nodiscard]] double seconds_left(const PreparedSearch& preparation, double time_limit);

/// Searches all of the preparation's variety; time and bits are noted in the preparation. Where the
/// forming of expressions was stopped the search ends for the same reason before its first box.
[[nodiscard]] Result run_search(PreparedSearch& preparation, const SearchOptions& search,
                                Settings settings, Observer* observer = nullptr,
                                const Checkpoint* from = nullptr);

/// Certifies a singularity at the first of these points of the variety, or between it and one of
/// the others, and closes in on it (see prove_singularity).
[[nodiscard]] Result prove_between(PreparedSearch& preparation, const SearchOptions& search,
                                   Settings settings, std::span<const std::vector<double>> points);

/// Closes in on the first singularity of a paving, whose points are as far apart as its box is
/// wide; where that does not succeed the result stays as it is.
void close_in_on_witness(PreparedSearch& preparation, const SearchOptions& search,
                         Settings settings, Result& result);

}  // namespace regulus::inline engine
