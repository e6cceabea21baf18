// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus check` for a program: the same search, the verdict as a value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regulus/codegen/driver/options.hpp"
#include "regulus/codegen/model/robot.hpp"
#include "regulus/kernel/isa.hpp"
#include "regulus/search/problem.hpp"
#include "regulus/search/result.hpp"

namespace regulus::codegen {

/// The options of `regulus check`. Numbers are texts, as there: "5*deg" is exact.
struct CheckOptions {
  std::vector<std::string> ranges;      ///< "p=LO:HI"
  std::vector<std::string> tolerances;  ///< "GROUP=E"
  std::string alpha;                    ///< empty: the motion's own
  Method method = Method::kAuto;
  Determinant determinant = Determinant::kBoth;
  std::optional<Entries> entries;  ///< nullopt: what fits the method
  Bisection bisection = Bisection::kImpact;
  Uncertainty uncertainty = Uncertainty::kElements;
  Engine engine = Engine::kJit;  ///< kAuto: compiled, and interpreted where there is no compiler
  std::optional<Isa> isa;        ///< nullopt: the best this processor has
  bool use_cache = true;
  std::vector<std::string> filters;  ///< shared objects
  std::vector<std::string> without;  ///< names of ingredients, as --help lists them
  std::uint64_t max_boxes = 0;       ///< 0: no bound
  unsigned threads = 0;              ///< 0: as many as there are processors
  double time_limit = 0;             ///< seconds, 0: no bound
  std::uint64_t symbolic_budget = kDeterminantBudget;  ///< terms of a closed form
  long precision = 1024;                               ///< most bits where doubles cannot decide
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
/// Threads   GiNaC and CLN, which robots are made of, count references without locks: their objects
///           may be used by one thread at a time in the whole process. Calls of check() wait for
///           each other, so that several threads may call it, each for a robot of its own, provided
///           that no thread makes, changes or destroys robots or expressions meanwhile.
/// Throws    InputError with the place in C++ for the robot, UsageError for the motion and the
///           options, CompileError and InternalError.
[[nodiscard]] Finding check(const Robot& robot, const std::string& motion = {},
                            const CheckOptions& options = {});

}  // namespace regulus::codegen
