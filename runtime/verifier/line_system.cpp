// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/line_system.hpp"

#include <map>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

/// Returns the question along the line. `numbers`: of the variable that is each coordinate.
Question along(const Question& q, const PlaceLine& line, const std::vector<int>& numbers) {
  Question result = q;
  Graph& graph = result.graph;
  const auto variable = [&graph](std::size_t k) { return graph.add(Op::kVariable, int(k)); };
  const NodeId part = variable(std::size_t(numbers[0]));
  std::map<NodeId, NodeId> values;
  for (std::size_t k = 0; k < line.from.size(); ++k) {
    NodeId value = line.from[k];
    if (line.to[k] != kNoNode)
      value =
          graph.add(Op::kAdd, value,
                    graph.add(Op::kMultiply, part, graph.add(Op::kSubtract, line.to[k], value)));
    values.emplace(variable(k), value);
  }
  for (std::size_t i = 1; i < numbers.size(); ++i)
    values.emplace(variable(line.from.size() + i - 1), variable(std::size_t(numbers[i])));
  const auto replace = [&](std::vector<NodeId>& roots) {
    for (NodeId& root : roots) root = replaced(graph, root, values);
  };
  result.defined = join({&q.defined, &q.motion_defined});
  result.motion_defined.clear();
  replace(result.closure->equations);
  replace(result.defined);
  result.variables.clear();
  result.ends.clear();
  return result;
}

Question swapped(const Question& q, const PlaceLine& line, std::size_t coordinate) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i <= q.closure->equations.size(); ++i)
    numbers.push_back(int(i == coordinate ? 0 : i < coordinate ? i + 1 : i));
  Question result = along(q, line, numbers);
  result.variables.resize(1);
  return result;
}

}  // namespace

LineSystem::LineSystem(const Question& question, const PlaceLine& line, std::size_t coordinate)
    : coordinate_(coordinate), question_(swapped(question, line, coordinate)), test_(question_) {}

SolutionBox LineSystem::unknowns_of(const std::vector<Interval>& point) const {
  SolutionBox result;
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (i == coordinate_) continue;
    result.middle.push_back(mid(point[i]));
    result.radius.push_back(radius_ru(point[i], result.middle.back()));
  }
  return result;
}

std::vector<Interval> LineSystem::point_of(Interval variable, const SolutionBox& unknowns) const {
  std::vector<Interval> result;
  for (std::size_t i = 0; i < unknowns.middle.size(); ++i)
    result.push_back(verifier::point(unknowns.middle[i]) +
                     Interval{-unknowns.radius[i], unknowns.radius[i]});
  result.insert(result.begin() + std::ptrdiff_t(coordinate_), variable);
  return result;
}

Question bordered_along(const Question& question, const PlaceLine& line,
                        std::span<const double> normal) {
  const std::size_t n = normal.size();
  std::vector<int> numbers;
  for (std::size_t i = 0; i <= n; ++i) numbers.push_back(int(i));
  Question result = along(question, line, numbers);
  Graph& graph = result.graph;
  std::vector<NodeId>& equations = result.closure->equations;
  std::vector<NodeId> moved(n, graph.number("0"));
  NodeId length = graph.number("-1");
  for (std::size_t i = 0; i < n; ++i) {
    const NodeId v = graph.add(Op::kVariable, int(1 + n + i));
    Differentiator by(graph, 1 + i);
    for (std::size_t j = 0; j < n; ++j) {
      const NodeId derivative = by.of(equations[j]);
      if (derivative != kNoNode)
        moved[j] = graph.add(Op::kAdd, moved[j], graph.add(Op::kMultiply, derivative, v));
    }
    length = graph.add(Op::kAdd, length,
                       graph.add(Op::kMultiply, graph.number(rational_of(normal[i])), v));
  }
  equations.insert(equations.end(), moved.begin(), moved.end());
  equations.push_back(length);
  return result;
}

}  // namespace regulus::verifier
