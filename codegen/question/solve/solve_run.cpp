// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_run.hpp"

#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {

Request read_solve_request(const ModelOptions& options, const FormingWatch& watch) {
  Request request = read_request(options, &watch);
  if (request.motion.trajectory)
    throw UsageError(
        "solutions are those at one place; name a motion that has one, or give its values by at");
  require_values(request);
  return request;
}

SolvedNoun noun_of(const Request&) {
  return {"configuration", "configurations", "the derivatives of the equations by the unknowns"};
}

Solutions solve(const Request& request, const SolveRun& run) {
  if (!request.model.closure)
    throw UsageError("solve is about models with [closure]; this one gives its matrix");
  PreparedSystem prepared = prepare_system(request, 0, run.search, run.watch, false);
  if (run.begin_search) run.begin_search();
  return solve_system(prepared, settings_of(prepared, run.search, run.interrupt), run.progress)
      .solutions;
}

}  // namespace regulus
