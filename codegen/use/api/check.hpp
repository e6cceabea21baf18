// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check` for a program: the same search, with the verdict as a value.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/use/api/question.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

struct Finding {
  Verdict verdict = Verdict::kPossibleProblem;
  std::string claim;                   ///< the statement that has been proved
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the report that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  Result result;                       ///< in the order of `variables`
  double seconds = 0;                  ///< of the whole call
  std::string certificate;             ///< the file of the proof; empty: none
  std::string no_certificate;          ///< why none could be written, if one was wanted
};

/// Proves that the motion has no singular pose, or shows one. A motion along way-points is checked
/// segment by segment; its `variables` are then empty.
///
/// With Engine::kAuto the search is interpreted unless the cache has the kernel, and the kernel is
/// compiled during a long search. The search ends soon after `interrupt` becomes true.
/// `certificate`: a file for the proof, as with --certificate; empty: none. `shard_size`: as with
/// --shard-size, in bytes; 0: the proof is one file.
///
/// Threads   Calls of the functions of regulus.hpp and of the constructors of its classes
///           wait for each other, so several threads may call them, if no thread makes, changes or
///           destroys robots or expressions of GiNaC at the same time.
/// Throws    InputError for the model, UsageError for the motion and the options, FileError,
///           CompileError and InternalError.
[[nodiscard]] Finding check(const Question& question, const SearchOptions& options = {},
                            const std::atomic<bool>* interrupt = nullptr,
                            const std::string& certificate = {}, std::uint64_t shard_size = 0);

}  // namespace regulus
