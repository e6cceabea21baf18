// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/load_lines.hpp"

#include <algorithm>

#include "runtime/verifier/constant_lines.hpp"
#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfLoad = 128;

class LoadReader {
 public:
  LoadReader(Lines& lines, Question& q) : lines_(lines, q), q_(q), load_(*q.load) {}

  void read() {
    if (q_.has_threshold) throw Rejection("a claim about forces has no threshold");
    load_.name = lines_.take("load");
    lines_.read_set(load_);
    for (std::size_t i = 0; i < q_.rows; ++i) {
      if (lines_.rest_of("limits") == format::kFree) {
        load_.least.push_back(kNoNode);
        load_.largest.push_back(kNoNode);
        lines_.advance();
        continue;
      }
      const auto [least, largest] = lines_.two_parts("limits", " : ");
      load_.least.push_back(lines_.constant("least", i, least));
      load_.largest.push_back(lines_.constant("largest", i, largest));
      lines_.advance();
    }
    scale_rows();
  }

 private:
  /// The matrix becomes J⁻¹. It is defined only where the scales are.
  void scale_rows() {
    if (q_.scale.empty()) return;
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      q_.matrix[e] = q_.graph.add(Op::kMultiply, q_.matrix[e], q_.scale[e / q_.columns]);
    q_.defined.insert(q_.defined.end(), q_.scale.begin(), q_.scale.end());
    q_.scale.clear();
  }

  ConstantLines lines_;
  Question& q_;
  LoadLines& load_;
};

Interval enclosure(const Question& q, NodeId node) {
  const auto value = evaluate(q.graph, {node}, {}, kBitsOfLoad);
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
  for (std::size_t i = 0; i < q.rows; ++i) {
    bounds.is_free.push_back(load.least[i] == kNoNode);
    if (bounds.is_free.back())
      add_limits(point(0.0), point(0.0), bounds);
    else
      add_limits(enclosure(q, load.least[i]), enclosure(q, load.largest[i]), bounds);
  }
  bounds.corners.emplace_back();
  for (std::size_t j = 0; j < q.columns; ++j)
    add_component(enclosure(q, load.middle[j]), nonnegative(q, load.spread[j]), bounds);
  for (const WrenchBall& ball : load.balls)
    bounds.balls.push_back({nonnegative(q, ball.radius), ball.members});
  return bounds;
}

}  // namespace regulus::verifier
