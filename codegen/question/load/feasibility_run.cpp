// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/feasibility_run.hpp"

#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/mechanism/motor_rows.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// The kernel needs the entries of the matrix and their derivatives, and no product.
SearchOptions with_derivatives(SearchOptions search) {
  search.method = Method::kReg;
  search.entries = Entries::kDerivatives;
  search.uncertainty = Uncertainty::kElements;
  return search;
}

/// Returns the unit of all limits; "1" if they have several.
std::string force_unit_of_limits(const Model& model) {
  const std::string unit = unit_of_motor_force(model, 0);
  for (std::size_t i = 0; i < model.actuators.force.size(); ++i)
    if (unit_of_motor_force(model, i) != unit) return "1";
  return unit;
}

}  // namespace

/// Formulas are left out: their terms may have another order in another process. No claim rests on
/// this text, since boxes are judged again.
nlohmann::ordered_json checkpointed_question(const PreparedForces& prepared,
                                             const FeasibilitySettings& settings) {
  nlohmann::ordered_json question = json_question(prepared.preparation, prepared.search);
  question.erase("options");  // they change how long it takes
  question.erase("pose_exact");
  question.erase("constraints_exact");
  question["load"] = json_vector_set(
      prepared.set(), units_of_wrench(prepared.request.model, twist_of(prepared.request.model)));
  for (const Interval& limit : prepared.limits) question["forces"].push_back({limit.lo, limit.hi});
  question["paves"] = settings.paves;
  question["least_width"] = settings.min_relative_width;
  return question;
}

PreparedForces prepare_forces(const ModelOptions& model, const std::string& load,
                              const SearchOptions& search, FormingWatch watch) {
  Stopwatch stopwatch;
  Request request = read_request(model, &watch);
  return prepare_forces(std::move(request), stopwatch.lap(), load, search, std::move(watch));
}

PreparedForces prepare_forces(Request request, double model_seconds, const std::string& load,
                              const SearchOptions& search, FormingWatch watch) {
  if (request.model.matrix_kind != MatrixKind::kInverse)
    throw UsageError(
        "--load: the matrix of a serial robot is its Jacobian in a frame of its own, so it has no "
        "loads");
  PreparedForces prepared;
  const VectorSet& set = choose_load(request.model, load);
  prepared.load = set.name;
  prepared.force_unit = force_unit_of_limits(request.model);
  prepared.limits = certain_limits(request.model);
  prepared.forces = force_problem(request.model, set);
  prepared.search = search;
  prepared.request = request;
  prepared.request.motion.alpha = 0;
  prepared.preparation = prepare(with_scaled_rows(std::move(request)), model_seconds,
                                 with_derivatives(search), std::move(watch));
  prepared.scaling = prepared.preparation.stages->formulation().scaling;
  prepared.problem = prepared.preparation.problem();
  return prepared;
}

FeasibilitySettings settings_of(const PreparedForces& prepared,
                                const std::atomic<bool>* interrupt) {
  FeasibilitySettings settings;
  set_limits(settings, prepared.preparation, prepared.search, interrupt);
  return settings;
}

FeasibilityResult run_forces(PreparedForces& prepared, const FeasibilitySettings& settings,
                             const ForceListener& listener, Observer* progress,
                             SearchCheckpoint* checkpoint) {
  const auto search = [&](const FeasibilitySettings& chosen) {
    return search_forces(prepared.question(), chosen, listener, progress);
  };
  FeasibilityResult result;
  if (checkpoint != nullptr && checkpoint->file() != nullptr) {
    FeasibilitySettings saving = settings;
    saving.save_every = checkpoint->interval();
    result = checkpoint->file()->continue_search(saving, search);
    checkpoint->finish(result.stopped_by.has_value() &&
                       (settings.paves || result.verdict == FeasibilityVerdict::kPossibleProblem));
  } else {
    result = search(settings);
  }
  prepared.preparation.seconds.search = result.seconds;
  return result;
}

}  // namespace regulus::detail
