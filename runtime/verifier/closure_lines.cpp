// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/closure_lines.hpp"

#include "runtime/verifier/constant_lines.hpp"

namespace regulus::verifier {
namespace {

/// Reads `unknown NAME = MIDDLE +- RADIUS`.
void read_unknown(ConstantLines& lines, Question& q, const Scope& commanded, Scope& actual) {
  ClosureLines& closure = *q.closure;
  const std::size_t number = closure.middle.size();
  const auto [name, value] = lines.two_parts("unknown", " = ");
  const std::size_t mark = value.find(" +- ");
  if (mark == std::string_view::npos) throw Rejection("expected 'unknown NAME = E +- E'");
  if (!is_name(name) || is_reserved(name))
    throw Rejection("'" + std::string(name) + "' cannot be a name");
  const std::size_t variable = q.variables.size() + number;
  if (number == format::kMostUnknowns || variable == format::kMostVariables)
    throw Rejection("too many unknowns");
  const NodeId node = q.graph.add(Op::kVariable, int(variable));
  if (commanded.contains(name) || !actual.emplace(name, node).second)
    throw Rejection("'" + std::string(name) + "' is declared twice");
  closure.names.emplace_back(name);
  closure.middle.push_back(lines.constant("unknown", name, value.substr(0, mark)));
  closure.radius.push_back(lines.constant("unknown-radius", name, value.substr(mark + 4)));
  lines.advance();
}

}  // namespace

void read_unknown_lines(Lines& lines, Question& q, const Scope& commanded, Scope& actual) {
  if (q.paves) q.load.reset();  // forces over a branch are a quantity
  if (q.load) throw Rejection("a claim about a closure is about singularity");
  ClosureLines& closure = q.closure.emplace();
  ConstantLines reader(lines, q);
  while (reader.is("unknown")) read_unknown(reader, q, commanded, actual);
  for (const Variable& v : q.variables) {
    if (v.kind != VariableKind::kParameter) continue;
    closure.start.push_back(reader.constant("start", v.name, reader.rest_of("start")));
    reader.advance();
  }
}

void read_equation_lines(Lines& lines, Question& q, const Scope& actual) {
  ClosureLines& closure = *q.closure;
  ConstantLines reader(lines, q);
  for (std::size_t i = 0; i < closure.middle.size(); ++i) {
    const std::string_view text = reader.rest_of("equation");
    closure.equations.push_back(parse(text, actual, q.graph));
    q.stated.emplace("equation " + std::to_string(i),
                     StatedValue{closure.equations.back(), lines.number(), std::string(text)});
    reader.advance();
  }
  q.rows = q.columns = closure.equations.size();
}

}  // namespace regulus::verifier
