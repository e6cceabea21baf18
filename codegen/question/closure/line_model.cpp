// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/line_model.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/model/exact/exact_double.hpp"

namespace regulus::detail {

using GiNaC::ex;

LineModel::LineModel(const PreparedClosure& prepared, const std::vector<double>& towards,
                     const std::vector<double>& uncertain)
    : given_(prepared.request), closure_(*given_.model.closure), part_("part_of_line") {
  GiNaC::exmap values;
  const std::set<std::string> names = uncertain_names(given_);
  std::size_t next = 0;
  for (const GeometryParameter& g : given_.model.geometry)
    values[g.symbol] = !uncertain.empty() && names.contains(g.name)
                           ? g.value + part_ * (exact_number(uncertain[next++]) - g.value)
                           : g.value;
  const std::vector<ex> from = start_of(given_.model, given_.motion);
  GiNaC::exmap place;
  for (std::size_t k = 0; k < from.size(); ++k)
    place[given_.motion.parameters[k].symbol] =
        from[k] + part_ * (exact_number(towards[k]) - from[k]);
  for (std::size_t i = 0; i < given_.model.pose.size(); ++i) {
    const bool has_error = !given_.motion.error.empty() && !given_.motion.error[i].is_zero();
    const ex error =
        has_error && !uncertain.empty() ? part_ * exact_number(uncertain[next++]) : ex(0);
    values[given_.model.pose[i].symbol] = error + given_.motion.pose[i].subs(place);
  }
  for (const ex& equation : closure_.equations) equations_.push_back(equation.subs(values));
  for (const ex& condition : given_.model.must_be_defined)
    conditions_.push_back(condition.subs(values));
  // The commanded pose has no errors.
  for (std::size_t i = 0; i < given_.model.pose.size(); ++i)
    values[given_.model.pose[i].symbol] = given_.motion.pose[i].subs(place);
  for (const ex& condition : given_.motion.must_be_defined)
    conditions_.push_back(condition.subs(values).subs(place));
}

Request LineModel::system(const std::optional<PoseParameter>& moves, const Range& range,
                          const ex& from, std::vector<PoseParameter> unknowns,
                          std::vector<Range> ranges, std::vector<ex> equations,
                          std::vector<ex> start, std::vector<ex> radius) const {
  Request request;
  request.model.name = given_.model.name;
  request.model.must_be_defined = conditions_;
  Closure& closure = request.model.closure.emplace();
  if (moves) {
    request.model.pose.push_back(*moves);
    request.motion.parameters.push_back({moves->symbol, moves->name, moves->unit, range});
    request.motion.pose.emplace_back(moves->symbol);
    request.motion.error.emplace_back(0);
    closure.start_pose.push_back(from);
  }
  closure.start_radius = std::move(radius);
  closure.unknowns = std::move(unknowns);
  closure.ranges = std::move(ranges);
  closure.equations = std::move(equations);
  closure.start = std::move(start);
  return request;
}

}  // namespace regulus::detail
