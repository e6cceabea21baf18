// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check` for a program: the same search, with the verdict as a value.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "codegen/api/question.hpp"
#include "codegen/engine/options.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline api {

struct Finding {
  Verdict verdict = Verdict::kPossibleProblem;
  std::string claim;                   ///< the statement that has been proved
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the report that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  Result result;                       ///< in the order of `variables`
};

/// Proves that the motion has no singular pose, or shows one.
///
/// The kernel is compiled before the search unless `options` select the interpreter; with
/// Engine::kAuto it is interpreted only if there is no compiler. The search ends soon after
/// `interrupt` becomes true.
///
/// Threads   Calls of check(), locate(), margin() and of the constructors of Question and Kernel
///           wait for each other, so several threads may call them, if no thread makes, changes or
///           destroys robots or expressions of GiNaC at the same time.
/// Throws    InputError for the model, UsageError for the motion and the options, FileError,
///           CompileError and InternalError.
[[nodiscard]] Finding check(const Question& question, const SearchOptions& options = {},
                            const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus::api
