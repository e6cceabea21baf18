// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/box_search.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/outside.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostHalvings = 30;  ///< of the range, for the reach of a solution
constexpr int kMostNarrowings = 8;
constexpr double kWorthwhile = 0.75;       ///< a box that stays larger is split
constexpr double kNarrowest = 0x1p-40;     ///< a part of the range
constexpr double kMuchNarrower = 0x1p-20;  ///< than the widest unknown: it is not halved

}  // namespace

bool is_in(std::span<const Interval> box, std::span<const Interval> other) {
  for (std::size_t i = 0; i < box.size(); ++i)
    if (!(other[i].lo <= box[i].lo && box[i].hi <= other[i].hi)) return false;
  return true;
}

bool is_in_one(std::span<const Interval> box, const std::vector<Box>& others) {
  return std::ranges::any_of(others, [&](const Box& other) { return is_in(box, other); });
}

bool are_disjoint(std::span<const Interval> a, std::span<const Interval> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].hi < b[i].lo || a[i].lo > b[i].hi) return true;
  return false;
}

BoxSearch::BoxSearch(Question& question, const std::vector<NodeId>& also, Box places,
                     WorkClock& clock, const Options& options, Verification& result)
    : q_(question),
      places_(std::move(places)),
      clock_(clock),
      options_(options),
      result_(result),
      test_(question, false),
      conditions_(join({&question.closure->equations, &also})),
      evaluation_(question, conditions_) {}

bool BoxSearch::is_empty(const Box& box) {
  Box all = places_;
  all.insert(all.end(), box.begin(), box.end());
  if (!evaluation_.run(all)) return false;
  return std::ranges::any_of(conditions_, [this](NodeId condition) {
    return !contains(evaluation_.value(condition), 0.0);
  });
}

std::optional<Box> BoxSearch::reach_of(const std::vector<double>& middle,
                                       const std::vector<double>& least) {
  for (int halving = 1; halving <= kMostHalvings + 1; ++halving) {
    std::vector<double> radius;
    for (std::size_t i = 0; i < least.size(); ++i)
      radius.push_back(
          halving > kMostHalvings ? least[i] : std::max(least[i], std::ldexp(width(i), -halving)));
    if (!test_.has_one_solution(places_, middle, radius, radius)) continue;
    Box box;
    for (std::size_t i = 0; i < radius.size(); ++i)
      box.push_back({up(middle[i] - radius[i]), down(middle[i] + radius[i])});
    return box;
  }
  return std::nullopt;
}

void BoxSearch::search(const Rest& has_rest, const std::function<void(const Box&)>& look_for_other,
                       const char* what) {
  std::vector<Box> waiting{range_};
  while (!waiting.empty()) {
    Box box = std::move(waiting.back());
    waiting.pop_back();
    if (!is_left(box, has_rest)) continue;
    const std::size_t widest = widest_of(box), i = to_halve(box, widest);
    const double at = mid(box[i]);
    if (part(box, widest) < kNarrowPart) look_for_other(box);
    if (!(part(box, widest) > kNarrowest) || !(box[i].lo < at && at < box[i].hi))
      give_up(box, what);
    waiting.push_back(box);
    waiting.back()[i].lo = at;
    box[i].hi = at;
    waiting.push_back(std::move(box));
    if (waiting.size() > format::kMostOpen) throw Unfinished("too many boxes are open");
  }
}

/// Returns false if the box has no other solution than those that are known. Narrows it to a part with all
/// others.
bool BoxSearch::is_left(Box& box, const Rest& has_rest) {
  for (int step = 0; step < kMostNarrowings; ++step) {
    clock_.tick();
    if (++result_.boxes > options_.max_boxes)
      throw Unfinished("the search needs more boxes than may be evaluated");
    if (is_empty(box)) return false;
    const Box before = box;
    if (!test_.narrow_to_solutions(places_, box) || !has_rest(box)) return false;
    bool is_narrower = false;
    for (std::size_t i = 0; i < box.size(); ++i)
      is_narrower =
          is_narrower || box[i].hi - box[i].lo < kWorthwhile * (before[i].hi - before[i].lo);
    if (!is_narrower) return true;
  }
  return true;
}

std::size_t BoxSearch::widest_of(const Box& box) const {
  std::size_t result = 0;
  for (std::size_t i = 1; i < box.size(); ++i)
    if (part(box, i) > part(box, result)) result = i;
  return result;
}

/// Returns the unknown by which the equations change most, of those that are not much narrower than
/// the widest.
std::size_t BoxSearch::to_halve(const Box& box, std::size_t widest) const {
  const std::vector<double>& shares = test_.shares();
  std::size_t result = widest;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] > shares[result] && part(box, i) > kMuchNarrower * part(box, widest)) result = i;
  return result;
}

void BoxSearch::give_up(const Box& box, const char* what) const {
  throw Unfinished("it was not shown that " + std::string(what) + " near " + place_of(box));
}

std::string BoxSearch::place_of(const Box& box) const {
  std::string text;
  for (std::size_t i = 0; i < box.size(); ++i)
    text += (i == 0 ? "" : ", ") + q_.closure->names[i] + " = " + std::to_string(mid(box[i]));
  return text;
}

}  // namespace regulus::verifier
