// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/section_values.hpp"

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/model_expression.hpp"

namespace regulus::verifier {

SectionQuantity section_quantity(const WrittenValues& values, const std::string& place,
                                 const SectionTolerance& shared, bool are_balls) {
  const auto at = values.lower_bound(place + '.');
  const bool is_table = at != values.end() && at->first.starts_with(place + '.');
  SectionQuantity result{is_table ? place + ".value" : place, shared, false, are_balls};
  for (const char* key : {".tolerance", ".radius"})
    if (values.contains(place + key)) {
      if (result.has_own_tolerance) throw Unfinished(place + " has a tolerance and a radius");
      result.tolerance.key = place + key;
      result.has_own_tolerance = true;
      result.is_ball = std::string_view(key) == ".radius";
    }
  return result;
}

NodeId SectionValues::constant(const std::string& place) {
  if (!comparer_.values().contains(place)) throw Unfinished("the file has no " + place);
  return checked(place, comparer_.expression_at(place, comparer_.question().actual));
}

SectionPoint SectionValues::middle(const std::string& place, std::size_t axes) {
  SectionPoint point{section_quantity(comparer_.values(), place, {}).value,
                     GraphAlgebra(comparer_.question().graph).zero()};
  for (std::size_t axis = 0; axis < axes; ++axis)
    point.value[axis] = constant(point.place + '[' + std::to_string(axis) + ']');
  return point;
}

NodeId SectionValues::checked(const std::string& place, NodeId node) {
  const Question& q = comparer_.question();
  for (const NodeId part : ingredients(q.graph, {node})) {
    const Node& known = q.graph.nodes()[std::size_t(part)];
    if (known.op == Op::kVariable &&
        q.variables[std::size_t(known.a)].kind != VariableKind::kUncertain)
      throw Unfinished(place + " depends on the pose");
  }
  comparer_.expect_defined(comparer_.place_of(place), node);
  return node;
}

/// In degrees `deg` is 1, but in the operand of a sine.
NodeId SectionValues::number_of_angle(const std::string& place) {
  const auto written = comparer_.values().find(place);
  if (!in_degrees_ || written == comparer_.values().end() || !written->second.is_string)
    return constant(place);
  Question& q = comparer_.question();
  const NameMeaning meaning = [&](std::string_view name) {
    if (const std::string let = "let." + std::string(name); comparer_.values().contains(let))
      return comparer_.expression_at(let, q.actual);
    const auto known = q.actual.find(name);
    if (known == q.actual.end())
      throw Unfinished("the name " + std::string(name) + " is not known");
    return known->second;
  };
  int depth = 0;
  const std::set<std::string, std::less<>> none;
  return checked(place,
                 parse_model_expression(written->second.text, meaning, q.graph, depth, none, true));
}

NodeId SectionValues::angle(const std::string& place) { return in_radians(number_of_angle(place)); }

void SectionValues::compare_spread(const std::string& name, const SectionTolerance& tolerance) {
  const bool is_given = comparer_.values().contains(tolerance.key);
  const NodeId spread = !is_given            ? algebra_.number(0)
                        : tolerance.is_angle ? angle(tolerance.key)
                                             : constant(tolerance.key);
  comparer_.compare(comparer_.place_of(tolerance.key), spread, "spread " + name, tolerance.option);
}

NodeId SectionValues::quantity(const std::string& place, const std::string& name,
                               const SectionTolerance& tolerance, std::vector<std::string>* names) {
  const NodeId written = tolerance.is_angle ? angle(place) : constant(place);
  const Question& q = comparer_.question();
  const std::string error = name + "_error";
  const bool has_error = q.stated.contains("value " + error);
  if (!has_error && !q.stated.contains("value " + name)) {
    if (comparer_.values().contains(tolerance.key)) compare_spread(name, tolerance);
    return written;
  }
  const std::string& own = has_error ? error : name;
  comparer_.compare(comparer_.place_of(place), has_error ? algebra_.number(0) : written,
                    "value " + own);
  compare_spread(own, tolerance);
  if (names != nullptr) names->push_back(own);
  return has_error ? algebra_.sum(written, q.actual.at(own)) : q.actual.at(own);
}

}  // namespace regulus::verifier
