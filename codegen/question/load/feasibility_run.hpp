// SPDX-License-Identifier: GPL-3.0-or-later
// The question of `regulus check --load` and `regulus locate --load`: can the motors hold a load?
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/load/feasibility_search.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// A question that is ready to be searched.
struct PreparedForces {
  PreparedSearch preparation;  ///< of J⁻¹, with the row scales in its entries
  Request request;             ///< with the row scales of the model, without a threshold
  std::string load;            ///< name
  std::string force_unit;
  std::vector<Interval> limits;  ///< forces certainly within them, by row, without free forces
  ForceProblem forces;
  MatrixScaling scaling;
  SearchOptions search;
  Problem problem;

  [[nodiscard]] ForceQuestion question() const { return {forces, problem, scaling}; }
  [[nodiscard]] const VectorSet& set() const { return choose_load(request.model, load); }
};

/// Reads the model and forms its matrix.
///
/// Requires  the motion is not along way-points.
/// Throws    UsageError if there is no such load or no limits, and for a threshold, which would be
///           ignored; the exceptions of prepare().
[[nodiscard]] PreparedForces prepare_forces(const ModelOptions& model, const std::string& load,
                                            const SearchOptions& search, FormingWatch watch);
/// Overload for a request that has been read in `model_seconds`.
///
/// Requires  its motion is not along way-points.
[[nodiscard]] PreparedForces prepare_forces(Request request, double model_seconds,
                                            const std::string& load, const SearchOptions& search,
                                            FormingWatch watch);

/// Returns the settings of a search within the rest of the time.
[[nodiscard]] FeasibilitySettings settings_of(const PreparedForces& prepared,
                                              const std::atomic<bool>* interrupt);

/// Returns everything that the boxes depend on, for a checkpoint.
[[nodiscard]] nlohmann::ordered_json checkpointed_question(const PreparedForces& prepared,
                                                           const FeasibilitySettings& settings);

/// Runs the search, and adds its time to the preparation's. `checkpoint`: null means none. The file
/// stays if the search may continue.
[[nodiscard]] FeasibilityResult run_forces(PreparedForces& prepared,
                                           const FeasibilitySettings& settings,
                                           const ForceListener& listener, Observer* progress,
                                           SearchCheckpoint* checkpoint = nullptr);

}  // namespace regulus::detail
