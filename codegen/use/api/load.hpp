// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check --load` and `regulus locate --load` for a program: can the motors hold a load?
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/load/force_claim.hpp"
#include "codegen/use/api/question.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus {

/// The answer for a load, or for its paving.
struct LoadFinding {
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  std::string claim;                   ///< the statement that has been proved; empty: none
  std::string reason;                  ///< of kPossibleProblem
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the report that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  std::uint64_t boxes = 0;             ///< that were evaluated
  double seconds = 0;                  ///< of the whole call
  std::string certificate;             ///< the file of the proof; empty: none
  std::string no_certificate;          ///< why none could be written, if one was wanted
};

/// Proves that at every pose of the motion forces within the limits of the model hold every wrench
/// of a load, or shows a pose and a wrench that none hold. `load`: empty if the model has only one.
/// Threads, errors, `certificate` and `shard_size` as for check().
[[nodiscard]] LoadFinding check_load(const Question& question, const std::string& load,
                                     const SearchOptions& options = {},
                                     const std::atomic<bool>* interrupt = nullptr,
                                     const std::string& certificate = {},
                                     std::uint64_t shard_size = 0);

struct LocateLoadOptions {
  SearchOptions search{};
  std::string load{};         ///< empty if the model has only one
  std::string resolution{};   ///< as LocateOptions::resolution
  std::string certificate{};  ///< a file for the proof of each box; empty: none
  /// Called for each box of the paving, in an order that depends on the question alone, with a
  /// range for each variable; the span is valid during the call. An exception ends the search.
  std::function<void(ForceClaim, std::span<const Interval>)> on_box{};
  std::uint64_t shard_size = 0;  ///< of the proof, as for check()
};

/// A part of a motion along way-points, from one place to another.
///
/// Ensures   the claim holds at each pose of this part, for all control errors and all values of the
///           uncertain quantities.
struct LoadStretch {
  ForceClaim claim = ForceClaim::kUndecided;
  std::size_t first_segment = 1, last_segment = 1;  ///< from 1
  double begin = 0, end = 1;  ///< the places, as parts of the first and of the last segment
  std::string json;           ///< the line that --output writes
};

struct LoadPaving {
  LoadFinding finding;  ///< of the whole motion
  /// Bounds of the fraction of the motion's box with each claim, in [0, 1]. They are [0, 1] for a
  /// motion along way-points, whose `finding.json` has approximate shares.
  Interval feasible{0.0}, infeasible{0.0}, undecided{0.0}, outside{0.0};
  std::vector<LoadStretch> stretches{};  ///< along way-points: in order, without gaps
};

/// Splits the motion into boxes in which the load is held at every pose, in which some wrench of it
/// is held at none, outside the constraints, or undecided. A motion along way-points is divided into
/// stretches, and has no boxes and no `variables`. Threads and errors as check().
[[nodiscard]] LoadPaving locate_load(const Question& question,
                                     const LocateLoadOptions& options = {},
                                     const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus
