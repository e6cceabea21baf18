// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/constant_lines.hpp"

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

void ConstantLines::advance() {
  if (!lines_.next()) throw Rejection("the file ends before the proof");
  if (lines_.number() > format::kMostLines)
    throw Rejection("there are too many lines before 'proof'");
}

bool ConstantLines::is(std::string_view key) const {
  const std::string_view line = lines_.text();
  return line.starts_with(key) && (line.size() == key.size() || line[key.size()] == ' ');
}

std::string_view ConstantLines::rest_of(std::string_view key) const {
  const std::string_view line = lines_.text();
  if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ')
    throw Rejection("expected a line '" + std::string(key) + " …'");
  return line.substr(key.size() + 1);
}

std::string ConstantLines::take(std::string_view key) {
  std::string rest(rest_of(key));
  advance();
  return rest;
}

std::pair<std::string_view, std::string_view> ConstantLines::two_parts(
    std::string_view key, std::string_view mark) const {
  const std::string_view text = rest_of(key);
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos)
    throw Rejection("expected '" + std::string(key) + " E" + std::string(mark) + "E'");
  return {text.substr(0, at), text.substr(at + mark.size())};
}

NodeId ConstantLines::constant(const char* kind, std::string_view name, std::string_view text) {
  return expression(kind, name, text, {});
}

NodeId ConstantLines::expression(const char* kind, std::string_view name, std::string_view text,
                                 const Scope& scope) {
  const NodeId node = parse(text, scope, q_.graph);
  q_.stated.emplace(std::string(kind) + ' ' + std::string(name),
                    StatedValue{node, lines_.number(), std::string(text)});
  return node;
}

std::vector<NodeId> ConstantLines::list(const char* key, std::size_t count) {
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    nodes.push_back(constant(key, i, rest_of(key)));
    advance();
  }
  return nodes;
}

void ConstantLines::read_set(VectorSetLines& set) {
  for (std::size_t j = 0; j < q_.columns; ++j) {
    const auto [middle, spread] = two_parts("wrench", " +- ");
    set.middle.push_back(constant("wrench", j, middle));
    set.spread.push_back(constant("wrench-spread", j, spread));
    advance();
  }
  for (; is("wrench-ball"); advance()) read_ball(set);
}

/// Reads `wrench-ball RADIUS in 4 5 6`: numbers of components, from 1.
void ConstantLines::read_ball(VectorSetLines& set) {
  if (set.balls.size() == q_.columns) throw Rejection("there are too many balls");
  const auto [radius, members] = two_parts("wrench-ball", " in ");
  WrenchBall ball{constant("wrench-ball", set.balls.size(), radius), {}};
  for (const std::string_view word : words_of(members)) {
    const std::size_t number = read_count(word, q_.columns);
    if (number == 0 || (!ball.members.empty() && ball.members.back() >= number - 1))
      throw Rejection("a ball has numbers of components in rising order, from 1");
    ball.members.push_back(number - 1);
  }
  set.balls.push_back(std::move(ball));
}

}  // namespace regulus::verifier
