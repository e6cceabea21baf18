// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_joint.hpp"

#include <algorithm>
#include <string_view>

#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/single_values.hpp"

namespace regulus::verifier {
namespace {

bool is_along(Question& q) {
  return !q.variables.empty() && q.variables[0].kind == VariableKind::kParameter &&
         are_equal(q.graph, q.variables[0].lo, q.graph.number("0")) &&
         are_equal(q.graph, q.variables[0].hi, q.graph.number("1"));
}

/// Returns the names of a commanded pose with these values of the first parameter and of the pieces.
Scope scope_at(const Pieces& pieces, std::size_t k, Question& q, const char* along) {
  Scope scope = q.commanded;
  const std::vector<std::string> values = pieces.values_of(k);
  for (std::size_t i = 0; i < values.size(); ++i)
    scope.insert_or_assign(pieces.names[i], parse(values[i], {}, q.graph));
  scope.insert_or_assign(q.variables[0].name, q.graph.number(along));
  return scope;
}

}  // namespace

void require_piece_of_closure(const Pieces& pieces, Question& q) {
  if (!is_along(q)) throw Unfinished("the first parameter of a piece does not go from 0 to 1");
  std::vector<std::string> moving = pieces.names;
  moving.push_back(q.variables[0].name);
  std::string_view rest = pieces.after;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (!line.starts_with("let ") && !line.starts_with("equation ")) continue;
    for (const std::string& name : moving)
      if (mentions(line, name))
        throw Unfinished("an equation uses '" + name + "', which is for the poses of a piece");
  }
}

void require_joint(const Pieces& pieces, std::size_t k, Question& q) {
  const Scope end = scope_at(pieces, k - 1, q, "1"), begin = scope_at(pieces, k, q, "0");
  for (const std::string& pose : q.closure->poses) {
    const std::string text = q.stated.at("pose " + pose).text;
    const std::string place = "piece " + std::to_string(k + 1) + " does not begin where piece " +
                              std::to_string(k) + " ends: " + pose + " differs";
    switch (equality(q, parse(text, end, q.graph), parse(text, begin, q.graph))) {
      case Equality::kEqual:
        break;
      case Equality::kDifferent:
        throw Rejection(place);
      case Equality::kUnknown:
        throw Unfinished("it was not shown that piece " + std::to_string(k + 1) +
                         " begins where piece " + std::to_string(k) + " ends, for " + pose);
    }
  }
}

}  // namespace regulus::verifier
