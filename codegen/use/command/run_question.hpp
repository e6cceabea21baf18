// SPDX-License-Identifier: GPL-3.0-or-later
// Asks a question of the command line, and prints its answer.
#pragma once

#include <atomic>

#include "codegen/answer/answer.hpp"
#include "codegen/answer/asked.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// A question with what the command line wants beside its answer.
struct CommandQuestion {
  Asked asked;
  OutputOptions output;
  Services services{};
  bool prints_lines = false;  ///< standard output has the lines of a paving
};

/// Each Throws UsageError for words that exclude each other.
[[nodiscard]] CommandQuestion question_of(const CheckCommand& command);
[[nodiscard]] CommandQuestion question_of(const LocateCommand& command);
[[nodiscard]] CommandQuestion question_of(const MarginCommand& command);
[[nodiscard]] CommandQuestion question_of(const BoundCommand& command);
[[nodiscard]] CommandQuestion question_of(const DatasheetCommand& command);
[[nodiscard]] CommandQuestion question_of(const SolveCommand& command);

/// Returns the exit code of the answer, after the report and all files are written.
/// `typed`: the command line as typed, for a page.
[[nodiscard]] int run_question(CommandQuestion question, const std::string& typed);

/// Prints why files are missing, on standard error, with --quiet too.
void print_lost(const Answer& answer);

/// Waits for the rest of an answer; returns the exit code, or ends the process with it. Where a file is
/// missing this is kFileError.
[[nodiscard]] int end_answer(Answer& answer, const OutputOptions& output,
                             const std::atomic<bool>& interrupted);

}  // namespace regulus::detail
