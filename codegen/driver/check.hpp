// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check` for a program: the same search, the verdict as a value.
#pragma once

#include <string>
#include <vector>

#include "regulus/codegen/driver/options.hpp"
#include "regulus/codegen/model/robot.hpp"
#include "regulus/search/result.hpp"

namespace regulus::codegen {

/// What the options of `regulus check` say.
struct CheckOptions {
  std::vector<std::string> ranges;      ///< "p=LO:HI"
  std::vector<std::string> tolerances;  ///< "GROUP=E"
  std::string alpha;                    ///< empty: the motion's own
  SearchOptions search;
};

struct Finding {
  Verdict verdict = Verdict::kPossibleProblem;
  std::string claim;                   ///< what has been proved, in words
  std::string report;                  ///< the lines that precede the verdict on a terminal
  std::string json;                    ///< the report that --json prints
  std::vector<std::string> variables;  ///< motion parameters, then uncertain quantities
  Result result;                       ///< in the order of `variables`
};

/// Searches one motion of the robot, its only one if `motion` is empty.
///
/// Throws    InputError with the place in C++ for the robot, UsageError for the motion and the
///           options, CompileError and InternalError. Not for two threads at once.
[[nodiscard]] Finding check(const Robot& robot, const std::string& motion = {},
                            const CheckOptions& options = {});

}  // namespace regulus::codegen
