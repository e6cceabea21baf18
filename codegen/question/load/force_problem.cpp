// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/force_problem.hpp"

#include <fmt/format.h>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// Returns the largest double interval within [lower, upper].
Interval within(const Interval& lower, const Interval& upper) {
  if (lower.hi > upper.lo)
    throw UsageError("[actuators] force: no double lies between the two limits of a row");
  return {lower.hi, upper.lo};
}

/// Appends a component to all corners; doubles their number if it has a range.
void append_component(std::vector<std::vector<Interval>>& corners, const GeometryParameter& c) {
  const bool is_range = c.ball < 0 && !c.tolerance.is_zero();
  const auto value = [&](const GiNaC::ex& e) { return enclose_constant(e, c.name); };
  if (!is_range) {
    for (auto& corner : corners) corner.push_back(value(c.value));
    return;
  }
  std::vector<std::vector<Interval>> upper = corners;
  for (auto& corner : corners) corner.push_back(value(c.value - c.tolerance));
  for (auto& corner : upper) corner.push_back(value(c.value + c.tolerance));
  corners.insert(corners.end(), upper.begin(), upper.end());
}

}  // namespace

std::vector<Interval> certain_limits(const Model& model) {
  if (model.actuators.force.empty())
    throw UsageError(
        "--load: the model does not say how large the forces of the motors may be; add [actuators] "
        "force = [LEAST, LARGEST]");
  std::vector<Interval> limits;
  for (const Range& limit : model.actuators.force)
    limits.push_back(within(enclose_constant(limit.lo, "the least force"),
                            enclose_constant(limit.hi, "the largest force")));
  return limits;
}

ForceProblem force_problem(const Model& model, const VectorSet& load) {
  ForceProblem problem;
  problem.certain = certain_limits(model);
  problem.rows = model.matrix.rows();
  problem.columns = model.matrix.cols();
  for (const Range& limit : model.actuators.force) {
    const Interval lower = enclose_constant(limit.lo, "the least force");
    const Interval upper = enclose_constant(limit.hi, "the largest force");
    problem.possible.push_back(hull(lower, upper));
  }
  // No motor drives the rows after the list: a constraint takes any force.
  problem.is_free.assign(problem.rows, false);
  for (std::size_t i = problem.certain.size(); i < problem.rows; ++i) problem.is_free[i] = true;
  problem.certain.resize(problem.rows, kEntire);
  problem.possible.resize(problem.rows, kEntire);
  std::size_t ranges = 0;
  for (const GeometryParameter& c : load.entries) ranges += c.ball < 0 && !c.tolerance.is_zero();
  if (ranges > kMostLoadRanges)
    throw UsageError(fmt::format(
        "--load: {} components of [load.{}] have a range, at most {} may; give a ball instead",
        ranges, load.name, kMostLoadRanges));
  problem.corners.emplace_back();
  for (const GeometryParameter& c : load.entries) append_component(problem.corners, c);
  for (const ToleranceBall& ball : load.balls)
    problem.balls.push_back({ball.members, enclose_constant(ball.radius, "the radius of a load")});
  return problem;
}

Request with_scaled_rows(Request request) {
  Model& model = request.model;
  if (!model.row_scale.empty()) {
    for (unsigned i = 0; i < model.matrix.rows(); ++i)
      for (unsigned j = 0; j < model.matrix.cols(); ++j)
        model.matrix(i, j) = model.matrix(i, j) * model.row_scale[i];
    append(model.must_be_defined, model.row_scale);
    model.row_scale.clear();
  }
  request.motion.alpha = 0;
  return request;
}

}  // namespace regulus::detail
