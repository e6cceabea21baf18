// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/nominal_copy.hpp"

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

/// Returns what stands in the place of each variable in the copies.
std::map<NodeId, NodeId> nominal_values(Question& q) {
  std::map<NodeId, NodeId> values = values_without_errors(q);
  const std::size_t m = q.variables.size(), n = q.closure->names.size();
  for (std::size_t i = 0; i < n; ++i)
    values.emplace(q.graph.add(Op::kVariable, int(m + i)),
                   q.graph.add(Op::kVariable, int(m + n + i)));
  return values;
}

/// Adds the copies of expressions behind them.
void copy(Graph& graph, std::vector<NodeId>& list, const std::map<NodeId, NodeId>& values) {
  for (std::size_t i = 0, count = list.size(); i < count; ++i)
    list.push_back(replaced(graph, list[i], values));
}

template <class T>
void repeat(std::vector<T>& list) {
  for (std::size_t i = 0, count = list.size(); i < count; ++i) list.push_back(T(list[i]));
}

}  // namespace

std::map<NodeId, NodeId> values_without_errors(Question& q) {
  std::map<NodeId, NodeId> values;
  for (std::size_t k = 0; k < q.variables.size(); ++k) {
    const Variable& v = q.variables[k];
    if (v.kind == VariableKind::kParameter) continue;
    values.emplace(q.graph.add(Op::kVariable, int(k)), v.kind == VariableKind::kError
                                                           ? q.graph.number("0")
                                                           : q.stated.at("value " + v.name).node);
  }
  return values;
}

void add_nominal_copy(Question& q) {
  ClosureLines& closure = *q.closure;
  if (q.variables.size() + 2 * closure.names.size() > format::kMostVariables)
    throw Unfinished("there are too many variables and unknowns for a finite error");
  const std::map<NodeId, NodeId> values = nominal_values(q);
  for (auto* list : {&closure.equations, &q.defined, &q.motion_defined})
    copy(q.graph, *list, values);
  repeat(closure.names), repeat(closure.middle), repeat(closure.radius);
}

}  // namespace regulus::verifier
