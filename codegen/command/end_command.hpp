// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "codegen/engine/pipeline.hpp"
#include "codegen/report/output_options.hpp"
#include "codegen/support/exit_code.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline command {

[[nodiscard]] ExitCode exit_code_of(Verdict verdict);

/// The end of a command that has written its report and closed its files, while the compiler of
/// PreparedSearch::late may still be at work. Returns the exit code of the verdict.
///
/// After a search that came to its end this waits for the compiler, so that the next run has the
/// kernel from the cache: the wait is no longer than the search was, as a rule; see
/// kBoxesBeforeCompiling. It ends the process at once if the search was interrupted or out of time
/// or memory, if nothing is kept (--no-cache), or once an interrupt comes during the wait.
/// A compiler cannot be stopped within a process, and the cache has an entry whole or not at all,
/// so that nothing is lost but the compiler's work.
[[nodiscard]] ExitCode end_command(PreparedSearch& preparation, const OutputOptions& output,
                                   const Result& result, const std::atomic<bool>& interrupted);

}  // namespace regulus::inline command
