// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "codegen/engine/pipeline.hpp"
#include "codegen/report/output_options.hpp"
#include "codegen/support/exit_code.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline command {

[[nodiscard]] ExitCode exit_code_of(Verdict verdict);

/// Ends a command that has written its report and closed its files, while the compiler of
/// PreparedSearch::late may still be running. Returns the exit code of the verdict.
///
/// After a complete search it waits for the compiler, so that the next run has the kernel from the
/// cache. The wait is usually shorter than the search; see kBoxesBeforeCompiling. It ends the
/// process at once if the search was interrupted or out of time or memory, if the cache is off
/// (--no-cache), or at an interrupt during the wait. A compiler cannot be stopped inside a process,
/// and the cache has an entry whole or not at all, so only the compiler's work is lost.
[[nodiscard]] ExitCode end_command(PreparedSearch& preparation, const OutputOptions& output,
                                   const Result& result, const std::atomic<bool>& interrupted);

}  // namespace regulus::command
