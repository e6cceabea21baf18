// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/load_lines.hpp"

#include <algorithm>

#include "runtime/certificate/verifier/evaluation.hpp"
#include "runtime/certificate/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBits = 128;

class LoadReader {
 public:
  LoadReader(Lines& lines, Question& q) : lines_(lines), q_(q), load_(*q.load) {}

  void read() {
    if (q_.has_threshold) throw Rejection("a claim about forces has no threshold");
    load_.name = rest_of("load");
    for (std::size_t j = 0; j < q_.columns; ++j) read_wrench(j);
    for (advance(); lines_.text().starts_with("wrench-ball "); advance()) read_ball();
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const auto [least, largest] = two_parts("limits", " : ");
      load_.least.push_back(constant("least", i, least));
      load_.largest.push_back(constant("largest", i, largest));
      advance();
    }
    scale_rows();
  }

 private:
  void advance() {
    if (!lines_.next()) throw Rejection("the file ends before the proof");
  }

  [[nodiscard]] std::string_view rest_of(std::string_view key) const {
    const std::string_view line = lines_.text();
    if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ')
      throw Rejection("expected a line '" + std::string(key) + " …'");
    return line.substr(key.size() + 1);
  }

  [[nodiscard]] std::pair<std::string_view, std::string_view> two_parts(
      std::string_view key, std::string_view mark) const {
    const std::string_view text = rest_of(key);
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos)
      throw Rejection("expected '" + std::string(key) + " E" + std::string(mark) + "E'");
    return {text.substr(0, at), text.substr(at + mark.size())};
  }

  NodeId constant(const char* kind, std::size_t number, std::string_view text) {
    const NodeId node = parse(text, {}, q_.graph);
    q_.stated.emplace(std::string(kind) + ' ' + std::to_string(number),
                      StatedValue{node, lines_.number(), std::string(text)});
    return node;
  }

  void read_wrench(std::size_t column) {
    advance();
    const auto [middle, spread] = two_parts("wrench", " +- ");
    load_.middle.push_back(constant("wrench", column, middle));
    load_.spread.push_back(constant("wrench-spread", column, spread));
  }

  /// Reads `wrench-ball RADIUS in 4 5 6`: numbers of components, from 1.
  void read_ball() {
    if (load_.balls.size() == q_.columns) throw Rejection("there are too many balls");
    const auto [radius, members] = two_parts("wrench-ball", " in ");
    WrenchBall ball{constant("wrench-ball", load_.balls.size(), radius), {}};
    for (const std::string_view word : words_of(members)) {
      const std::size_t number = read_count(word, q_.columns);
      if (number == 0 || (!ball.members.empty() && ball.members.back() >= number - 1))
        throw Rejection("a ball has numbers of components in rising order, from 1");
      ball.members.push_back(number - 1);
    }
    load_.balls.push_back(std::move(ball));
  }

  /// The matrix becomes J⁻¹. It is defined only where the scales are.
  void scale_rows() {
    if (q_.scale.empty()) return;
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      q_.matrix[e] = q_.graph.add(Op::kMultiply, q_.matrix[e], q_.scale[e / q_.columns]);
    q_.defined.insert(q_.defined.end(), q_.scale.begin(), q_.scale.end());
    q_.scale.clear();
  }

  Lines& lines_;
  Question& q_;
  LoadLines& load_;
};

Interval enclosure(const Question& q, NodeId node) {
  const auto value = evaluate(q.graph, {node}, {}, kBits);
  const Interval x = value ? (*value)[0].enclosure() : everything();
  if (!is_bounded(x)) throw Unfinished("a value of the load or of a limit is not certain");
  return x;
}

Interval nonnegative(const Question& q, NodeId node) {
  const Interval x = enclosure(q, node);
  if (x.hi < 0.0) throw Rejection("a spread or a radius of the load is negative");
  if (x.lo < 0.0) throw Unfinished("a spread or a radius of the load has no certain sign");
  return x;
}

void add_limits(const Interval least, const Interval largest, LoadBounds& bounds) {
  if (largest.hi < least.lo) throw Rejection("the limits of a force are empty");
  if (largest.lo < least.hi) throw Unfinished("no double lies within the limits of a force");
  bounds.certain.push_back({least.hi, largest.lo});
  bounds.possible.push_back({least.lo, largest.hi});
}

void add_component(const Interval middle, const Interval spread, LoadBounds& bounds) {
  bounds.middle.push_back(middle);
  bounds.spread.push_back(spread);
  if (is_zero(spread)) {
    for (auto& corner : bounds.corners) corner.push_back(middle);
    return;
  }
  if (bounds.corners.size() >> format::kMostLoadRanges != 0)
    throw Unfinished("too many components of the load have a range");
  auto upper = bounds.corners;
  for (auto& corner : bounds.corners) corner.push_back(middle - spread);
  for (auto& corner : upper) corner.push_back(middle + spread);
  bounds.corners.insert(bounds.corners.end(), upper.begin(), upper.end());
}

}  // namespace

void read_load_lines(Lines& lines, Question& question) { LoadReader(lines, question).read(); }

LoadBounds enclose_load(const Question& q) {
  const LoadLines& load = *q.load;
  LoadBounds bounds;
  for (std::size_t i = 0; i < q.rows; ++i)
    add_limits(enclosure(q, load.least[i]), enclosure(q, load.largest[i]), bounds);
  bounds.corners.emplace_back();
  for (std::size_t j = 0; j < q.columns; ++j)
    add_component(enclosure(q, load.middle[j]), nonnegative(q, load.spread[j]), bounds);
  for (const WrenchBall& ball : load.balls)
    bounds.balls.push_back({nonnegative(q, ball.radius), ball.members});
  return bounds;
}

}  // namespace regulus::verifier
