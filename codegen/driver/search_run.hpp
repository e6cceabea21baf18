// SPDX-License-Identifier: GPL-3.0-or-later
// Running a search from a command: with more digits at hand, a display of its progress, and an exit
// code for its verdict.
#pragma once

#include <atomic>
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

/// The end of a command that has written its report and closed its files, while the compiler of
/// Preparation::late may still be at work. Returns the exit code of the verdict.
///
/// After a search that came to its end this waits for the compiler, so that the next run has the
/// kernel from the cache: the wait is no longer than the search was, as a rule; see
/// kBoxesBeforeCompiling. It ends the process at once if the search was interrupted or out of time
/// or memory, if nothing is kept (--no-cache), or once an interrupt comes during the wait.
/// A compiler cannot be stopped within a process, and the cache has an entry whole or not at all,
/// so that nothing is lost but the compiler's work.
[[nodiscard]] ExitCode end_command(Preparation& preparation, const OutputOptions& output,
                                   const Result& result, const std::atomic<bool>& interrupted);

}  // namespace regulus::codegen
