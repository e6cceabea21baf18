// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_start.hpp"

#include <algorithm>

#include "runtime/verifier/single_values.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfStart = 128;

Interval enclosure(const Graph& graph, NodeId node) {
  const auto value = evaluate(graph, {node}, {}, kBitsOfStart);
  const Interval x = value ? (*value)[0].enclosure() : everything();
  if (!is_bounded(x)) throw Unfinished("a value of the start has no certain value");
  return x;
}

}  // namespace

std::vector<NodeId> start_values(Question& q) {
  std::vector<NodeId> values;
  for (std::size_t k = 0; k < q.variables.size(); ++k) {
    const Variable& v = q.variables[k];
    values.push_back(
        v.kind == VariableKind::kParameter
            ? q.closure->start[k]
            : q.graph.add(Op::kDivide, q.graph.add(Op::kAdd, v.lo, v.hi), q.graph.number("2")));
  }
  return values;
}

Box start_place(Question& q, const Variety& variety) {
  Box place;
  const std::vector<NodeId> values = start_values(q);
  for (std::size_t k = 0; k < q.variables.size(); ++k) {
    const Variable& v = q.variables[k];
    const Interval range = variety.outer[k];
    place.push_back(enclosure(q.graph, values[k]));
    if (v.kind != VariableKind::kParameter) {
      place[k] = {std::max(place[k].lo, range.lo), std::min(place[k].hi, range.hi)};
      continue;
    }
    if (place[k].hi < range.lo || place[k].lo > range.hi)
      throw Rejection("the start is not within the range of " + v.name);
    if (place[k].lo < range.lo || place[k].hi > range.hi)
      throw Unfinished("the start may not be within the range of " + v.name);
    // Nothing depends on a variable of one value any more, so the start must have that value.
    if (are_equal(q.graph, v.lo, v.hi) && !are_equal(q.graph, q.closure->start[k], v.lo))
      throw Unfinished("the start may not be at the only value of " + v.name);
  }
  return place;
}

StartBox::StartBox(const Question& q) {
  for (std::size_t i = 0; i < q.closure->middle.size(); ++i) {
    const Interval start = enclosure(q.graph, q.closure->middle[i]);
    const Interval radius = enclosure(q.graph, q.closure->radius[i]);
    if (!(radius.hi > 0.0)) throw Rejection("a radius of the start is not positive");
    middle_.push_back(mid(start));
    const Interval off = point(mag(start - point(middle_[i])));
    outer_.push_back((radius + off).hi);
    inner_.push_back((radius - off).lo);
  }
}

SolutionBox StartBox::only_solution(BranchTest& test, const Box& place,
                                    std::span<const double> scale) const {
  if (!test.has_one_start(place, middle_, outer_, inner_))
    throw Unfinished("it was not shown that the start is near to exactly one configuration");
  auto solution = test.solution_near(place, middle_, scale);
  bool is_near = solution.has_value();
  for (std::size_t i = 0; is_near && i < middle_.size(); ++i)
    is_near = mag(point(solution->middle[i]) - point(middle_[i]) +
                  Interval{-solution->radius[i], solution->radius[i]}) <= inner_[i];
  if (!is_near) throw Unfinished("the configuration at the start was not found");
  return *std::move(solution);
}

}  // namespace regulus::verifier
