// SPDX-License-Identifier: GPL-3.0-or-later
// Running a search from a command: with more digits at hand, a display of its progress, and an exit
// code for its verdict.
#pragma once

#include <span>
#include <vector>

#include "regulus/checkpoint/checkpoint.hpp"
#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/search/observer.hpp"

namespace regulus::codegen {

/// The seconds of a time limit that the stages before the search have left.
[[nodiscard]] double seconds_left(const Preparation& preparation, double time_limit);

/// Searches all of the preparation's variety; time and bits are noted in the preparation. Where the
/// forming of expressions was stopped the search ends for the same reason before its first box.
[[nodiscard]] Result run_search(Preparation& preparation, const SearchOptions& search,
                                const OutputOptions& output, Settings settings,
                                Observer* observer = nullptr, const Checkpoint* from = nullptr);

/// Certifies a singularity at the first of these points of the variety, or between it and one of
/// the others, and closes in on it (see prove_singularity).
[[nodiscard]] Result prove_between(Preparation& preparation, const SearchOptions& search,
                                   Settings settings, std::span<const std::vector<double>> points);

/// Closes in on the first singularity of a paving, whose points are as far apart as its box is
/// wide; where that does not succeed the result stays as it is.
void close_in_on_witness(Preparation& preparation, const SearchOptions& search, Settings settings,
                         Result& result);

[[nodiscard]] ExitCode exit_code_of(Verdict verdict);

}  // namespace regulus::codegen
