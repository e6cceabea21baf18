// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/question/engine/settings.hpp"
#include "codegen/question/solve/arm_postures.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/platform_poses.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/question/solve/turning_tool.hpp"
#include "codegen/question/solve/varying_place.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {

namespace {

/// Nothing that a motion says beside its place may be lost.
void require_place_alone(const Motion& motion) {
  if (!motion.constraints.empty())
    throw UsageError(fmt::format(
        "the motion {} has constraints, and all solutions at a place are listed, whatever they "
        "meet; give the place by at, or by a motion without constraints",
        motion.name));
}

}  // namespace

Request read_solve_request(const ModelOptions& options, const FormingWatch& watch,
                           const std::vector<std::string>& held) {
  return solve_request_of(read_model(model_text(options), options, &watch), options, {}, held);
}

Request solve_request_of(Model model, const ModelOptions& options,
                         std::span<const GivenNumber> more, const std::vector<std::string>& held) {
  ModelOptions given = options;
  given.takes_legs = true;
  Request request = request_of(std::move(model), given, more);
  if (request.motion.trajectory)
    throw UsageError(
        "solve answers for places, which nothing joins; give a table of them as its waypoints, "
        "one place a line, or name a motion that has one place, or give its values by at");
  require_place_alone(request.motion);
  require_values(request);
  let_tool_turn(request, held);
  let_place_vary(request);
  return request;
}

SolvedNoun noun_of(const Request& request) {
  const Model& model = request.model;
  if (!model.legs.empty())
    return {"pose", "poses",
            model.legs.size() == 3
                ? "the derivatives of the legs' squares by the pose"
                : "the inverse Jacobian, its rows those of unit forces along the legs"};
  if (model.arm)
    return {"posture", "postures", "the forward Jacobian at the end of the last joint"};
  return {"configuration", "configurations", "the derivatives of the equations by the unknowns"};
}

RootSettings root_settings_of(const SolveRun& run) {
  RootSettings settings;
  settings.threads = settings_from(run.search).threads;
  settings.interrupt = run.interrupt;
  if (run.search.max_boxes != 0) settings.max_boxes = run.search.max_boxes;
  if (run.search.time_limit != 0) settings.time_limit = run.search.time_limit;
  settings.workers = run.search.workers;
  settings.keep = run.keep;
  return settings;
}

RootSettings root_settings_of(const SolveRun& run, const PreparedSystem& prepared) {
  RootSettings settings;
  static_cast<BoxSearchSettings&>(settings) = settings_of(prepared, run.search, run.interrupt);
  settings.keep = run.keep;
  return settings;
}

Solutions solve(const Request& request, const SolveRun& run) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  if (!run.held.empty() && !request.model.arm)
    throw UsageError("only an arm of [serial] has joints that can be held");
  if (!request.model.legs.empty()) return solve_platform(request, run);
  if (request.model.arm) return solve_arm(request, run);
  if (!request.model.closure)
    throw UsageError(
        "the solutions of this model cannot be asked for: give its equations in [closure], or legs "
        "of "
        "variable length in [gough] or [legs], or an arm in [serial]");
  PreparedSystem prepared =
      prepare_system(request, 0, run.search, run.watch, DerivativesBy::kUnknowns);
  run.begin();
  return solve_system(prepared, root_settings_of(run, prepared), run.progress);
}

}  // namespace regulus::detail
