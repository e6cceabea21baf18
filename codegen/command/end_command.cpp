// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/end_command.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace regulus::inline command {
namespace {

/// True if the compiler's work is kept for a later run and no end was requested.
bool is_worth_waiting(const PreparedSearch& preparation, const Result& result) {
  return preparation.cache != name(CacheUse::kOff) &&
         (!result.stopped_by || *result.stopped_by == Reason::kBoxBudget ||
          *result.stopped_by == Reason::kStalled);
}

}  // namespace

ExitCode end_command(PreparedSearch& preparation, const OutputOptions& output, const Result& result,
                     const std::atomic<bool>& interrupted) {
  const ExitCode code = exit_code_of(result.verdict);
  LateCompilation* const late = preparation.late.get();
  std::cout.flush();
  if (late == nullptr || !std::cout) return code;
  if (late->is_compiling() && !(is_worth_waiting(preparation, result) && late->wait(interrupted))) {
    std::fflush(nullptr);
    ::_exit(code);
  }
  if (!late->failure().empty() && !output.quiet)
    std::cerr << "compiler   not available, so the whole search was interpreted: "
              << late->failure() << '\n';
  return code;
}

ExitCode exit_code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return kNoSingularity;
    case Verdict::kSingularity:
      return kSingularity;
    case Verdict::kPossibleProblem:
      return kPossibleProblem;
  }
  return kInternalFault;
}

}  // namespace regulus::command
