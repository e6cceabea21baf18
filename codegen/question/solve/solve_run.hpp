// SPDX-License-Identifier: GPL-3.0-or-later
// From a model and a place to the list of all solutions: which equations are solved, and how.
#pragma once

#include <functional>

#include "codegen/model/place.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/solve/root_search.hpp"
#include "codegen/question/solve/solutions.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// Reads the model, and the place that the options name. `held`: joints of an arm that keep their values.
///
/// Throws    as read_request(); UsageError if the motion is along way-points or has ranges.
[[nodiscard]] Request read_solve_request(const ModelOptions& options, const FormingWatch& watch,
                                         const std::vector<std::string>& held = {});
/// The same of a model that is read, with `more` numbers of the place.
[[nodiscard]] Request solve_request_of(Model model, const ModelOptions& options,
                                       std::span<const GivenNumber> more,
                                       const std::vector<std::string>& held = {});

/// Returns what the solutions of a model are called.
[[nodiscard]] SolvedNoun noun_of(const Request& request);

struct SolveRun {
  const SearchOptions& search;
  FormingWatch watch;
  const std::atomic<bool>* interrupt = nullptr;
  Observer* progress = nullptr;          ///< null: none
  std::function<void()> begin_search{};  ///< called when the search begins
  std::vector<std::string> held{};       ///< joints of an arm that keep their values
  /// As RootSettings::keep: called for each search at this place, always in the same order.
  std::function<RootList(const RootSettings&, const RootSearch&)> keep{};

  void begin() const {
    if (begin_search) begin_search();
  }
};

/// Returns the settings of a search of this run.
[[nodiscard]] RootSettings root_settings_of(const SolveRun& run);
/// The same, of a search whose kernel took a part of the time.
[[nodiscard]] RootSettings root_settings_of(const SolveRun& run, const PreparedSystem& prepared);

/// Finds all solutions.
///
/// Throws    UsageError for a model whose solutions cannot be asked for; the exceptions of prepare().
[[nodiscard]] Solutions solve(const Request& request, const SolveRun& run);

}  // namespace regulus::detail
