// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus solve` for a program: all configurations, poses or postures at one place.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/solve/solutions.hpp"
#include "codegen/use/api/question.hpp"

namespace regulus {

struct SolveOptions {
  SearchOptions search{};
  std::vector<std::string> at{};    ///< "NAME=VALUE": numbers of the place
  std::vector<std::string> hold{};  ///< joints of an arm that keep the values of the motion
  /// A file for the proof, of solve_many() for the proofs at all places; empty: none.
  std::string certificate{};
  std::uint64_t shard_size = 0;  ///< of solve_many(): as of check()
};

struct SolveFinding {
  Solutions solutions;
  std::string headline;          ///< "COMPLETE: 6 poses"
  std::string report;            ///< the lines that precede it on a terminal
  std::string json;              ///< the report that --json prints
  double seconds = 0;            ///< of the whole call
  std::string certificate{};     ///< the file of the proof; empty: none
  std::string no_certificate{};  ///< why none could be written, if one was wanted
};

/// Finds all solutions, and proves that these are all, or says why this is not shown. Threads and
/// errors as check().
[[nodiscard]] SolveFinding solve(const Question& question, const SolveOptions& options = {},
                                 const std::atomic<bool>* interrupt = nullptr);

/// Many places, each "NAME=VALUE" of its numbers beside those of SolveOptions::at; or a table of them
/// in a file, as of way-points, with one a line.
struct Places {
  std::vector<std::vector<std::string>> numbers{};
  std::string table{};  ///< empty: the numbers above, or the way-points of the motion
};

struct SolveManyFinding {
  std::vector<SolvedPlace> places;  ///< in their order
  std::uint64_t left = 0;           ///< places that were not asked any more, after an interrupt
  std::string headline;             ///< "NONE at 1, COMPLETE at 2 of 3 places: 12 poses"
  std::string report;               ///< the lines that precede it on a terminal
  std::string json;                 ///< the report that --json prints
  double seconds = 0;               ///< of the whole call
  std::string certificate{};        ///< the file of the proofs; empty: none
  std::string no_certificate{};     ///< why none could be written, if one was wanted
};

/// Solves each of many places. Limits of the search are those of each place; threads and errors as
/// check(), and UsageError if there is no place.
[[nodiscard]] SolveManyFinding solve_many(const Question& question, const Places& places,
                                          const SolveOptions& options = {},
                                          const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus
