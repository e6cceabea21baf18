// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus locate` for a program: a paving of the motion, with each box as soon as it is known.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "codegen/api/question.hpp"
#include "codegen/engine/options.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::inline api {

struct LocateOptions {
  SearchOptions search;
  std::string resolution;  ///< part of each range, such as "1/64"; empty: by the number of ranges
  /// Called for each box of the paving, in an order that depends on the question alone, with a
  /// range for each variable; the span is valid during the call.
  std::function<void(Claim, std::span<const Interval>)> on_box{};
};

struct Paving {
  Verdict verdict = Verdict::kPossibleProblem;  ///< of the whole motion
  /// Bounds of the fraction of the motion's box with each claim, in [0, 1].
  Interval free{0.0}, singular{0.0}, undecided{0.0}, outside{0.0}, unreachable{0.0};
  Interval workspace{1.0};             ///< the fraction that meets the constraints
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the summary that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  Result result;
};

/// Splits the motion into boxes that are proved free, proved singular, outside the constraints, out
/// of reach (if the motion says where = "reachable"), or undecided at that resolution. Threads and errors as check().
[[nodiscard]] Paving locate(const Question& question, const LocateOptions& options = {},
                            const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus::api
