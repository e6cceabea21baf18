// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/outside.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::verifier {
namespace {

constexpr long kBitsOfPoint = 64;
constexpr double kNarrowestSplit = 0x1p-44;  ///< of a range, relative to the variety's

}  // namespace

Outside::Outside(const Question& question, const Variety& variety)
    : q_(question),
      variety_(variety),
      motion_(question, join({&question.motion_defined, &question.constraints})) {}

bool Outside::covers(const Box& box) {
  for (std::size_t b = 0; b < q_.balls.size(); ++b)
    if (is_beyond(q_.balls[b], variety_.reach[b], box)) return true;
  if (q_.constraints.empty() || !motion_.run(box)) return false;
  return std::any_of(q_.constraints.begin(), q_.constraints.end(),
                     [this](NodeId h) { return motion_.value(h).lo > 0.0; });
}

/// Returns true if every point of the box is farther than `reach` from the middle of the ball.
bool Outside::is_beyond(const BallOfVariables& ball, double reach, const Box& box) const {
  Interval distance;
  for (const std::size_t k : ball.members)
    distance = distance + square(box[k] - point(mid(variety_.outer[k])));
  return sqrt(distance).lo > reach;
}

void place_middle(const Variety& variety, const Box& box, Middle& middle) {
  middle.point = box;
  middle.radius.assign(box.size(), 0.0);
  for (std::size_t k = 0; k < box.size(); ++k) {
    const auto& inner = variety.inner[k];
    if (!inner) continue;
    const Interval doubles{std::max(box[k].lo, inner->lo), std::min(box[k].hi, inner->hi)};
    if (!(doubles.lo <= doubles.hi)) continue;
    middle.point[k] = point(mid(doubles));
    middle.radius[k] = radius_ru(box[k], middle.point[k].lo);
  }
}

bool is_certain_point(const Question& q, const Variety& variety, const Box& point) {
  if (!certain_inside(q, variety, point)) return false;
  std::vector<Ball> x;
  for (const Interval coordinate : point) x.emplace_back(coordinate, kBitsOfPoint);
  const auto values = evaluate(q.graph, q.constraints, x, kBitsOfPoint);
  return values && std::all_of(values->begin(), values->end(),
                               [](const Ball& h) { return arb_is_nonpositive(h.get()) != 0; });
}

std::vector<NodeId> join(std::initializer_list<const std::vector<NodeId>*> lists) {
  std::vector<NodeId> result;
  for (const auto* list : lists) result.insert(result.end(), list->begin(), list->end());
  return result;
}

std::optional<std::size_t> variable_of_impact(const Variety& variety, const Box& box,
                                              const std::vector<double>& impact) {
  const bool has_impact = std::any_of(impact.begin(), impact.end(),
                                      [](double x) { return x > 0.0 && std::isfinite(x); });
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t k = 0; k < box.size(); ++k) {
    const Interval x = box[k], root = variety.outer[k];
    const double middle = mid(x), width = (x.hi - x.lo) / (root.hi - root.lo);
    if (!(x.lo < middle && middle < x.hi && width > kNarrowestSplit)) continue;
    const double score = has_impact ? impact[k] : width;
    if (score > most) best = k, most = score;
  }
  return best;
}

std::pair<Box, Box> halves(const Box& box, std::size_t k) {
  std::pair<Box, Box> result{box, box};
  result.first[k].hi = result.second[k].lo = mid(box[k]);
  return result;
}

}  // namespace regulus::verifier
