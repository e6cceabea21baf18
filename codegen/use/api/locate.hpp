// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus locate` for a program: a paving of the motion, with each box as soon as it is known.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/use/api/question.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/paving.hpp"

namespace regulus {

struct LocateOptions {
  SearchOptions search{};
  std::string resolution{};  ///< part of each range, such as "1/64"; empty: by the number of ranges
  /// Called for each box of the paving, in an order that depends on the question alone, with a
  /// range for each variable; the span is valid during the call. A motion along way-points has
  /// `stretches` and no boxes.
  std::function<void(Claim, std::span<const Interval>)> on_box{};
  std::string certificate{};     ///< a file for the proof of the verdict; empty: none
  std::uint64_t shard_size = 0;  ///< of the proof, as for check()
};

/// A part of a motion along way-points, from one place to another.
///
/// Ensures   the claim holds for this part, for all control errors and all values of the uncertain
///           quantities. A singular one contains a singular pose for some of these.
struct Stretch {
  Claim claim = Claim::kUndecided;
  std::size_t first_segment = 1, last_segment = 1;  ///< from 1
  double begin = 0, end = 1;  ///< the places, as parts of the first and of the last segment
  std::string json;           ///< the line that --output writes
};

struct Paving {
  Verdict verdict = Verdict::kPossibleProblem;  ///< of the whole motion
  /// Bounds of the fraction of the motion's box with each claim, in [0, 1]. They are [0, 1] for a
  /// motion along way-points, whose `json` has approximate shares.
  Interval free{0.0}, singular{0.0}, undecided{0.0}, outside{0.0}, unreachable{0.0};
  Interval workspace{1.0};             ///< the fraction that meets the constraints
  std::vector<Stretch> stretches;      ///< along way-points: in order, without gaps
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the summary that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  Result result;
  std::string certificate;     ///< the file of the proof; empty: none
  std::string no_certificate;  ///< why none could be written, if one was wanted
};

/// Splits the motion into boxes that are proved free, proved singular, outside the constraints, out
/// of reach (if the motion says where = "reachable"), or undecided at that resolution. A motion along
/// way-points is divided into stretches; it has no `variables`. The certificate of a mechanism with loops
/// proves on which boxes or stretches its branch is regular.
/// Threads and errors as check().
[[nodiscard]] Paving locate(const Question& question, const LocateOptions& options = {},
                            const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus
