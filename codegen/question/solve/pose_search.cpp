// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/pose_search.hpp"

#include <algorithm>
#include <utility>

#include "runtime/kernel/buffers.hpp"
#include "runtime/solutions/pose_equations.hpp"

namespace regulus {
namespace {

/// The equations of one chart.
class ChartSystem final : public RootSystem {
 public:
  ChartSystem(const PoseEquations& equations, int chart)
      : equations_(equations),
        chart_(chart),
        rows_(equations.rows()),
        in_(equations.unknowns()),
        out_(static_cast<std::size_t>(rows_.all())) {}

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Box& box = boxes[std::min(lane, boxes.size() - 1)];
      for (std::size_t k = 0; k < box.size(); ++k) in_.set(k, lane, box[k]);
    }
    equations_.evaluate(chart_, in_.data(), out_.data(), has_rates);
    has_rates_ = has_rates;
  }

  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override {
    const auto take = [&](std::vector<Interval>& values, int first, int last) {
      values.reserve(static_cast<std::size_t>(last - first));
      for (int i = first; i < last; ++i)
        values.push_back(out_.get(static_cast<std::size_t>(i), lane));
    };
    Values values;
    take(values.value, 0, rows_.derivatives());
    take(values.by_unknown, rows_.derivatives(), rows_.extras());
    take(values.also, rows_.extras(), rows_.rates());
    if (has_rates_) take(values.rates_by_unknown, rows_.rates(), rows_.all());
    return values;
  }

 private:
  const PoseEquations& equations_;
  const int chart_;
  const PoseRows rows_;
  IntervalRows in_, out_;
  bool has_rates_ = false;
};

/// A solution in a chart.
struct ChartRoot {
  int chart;
  Root root;

  [[nodiscard]] std::array<Interval, 4> quaternion() const {
    return PoseEquations::quaternion_of(chart, root.values);
  }
  [[nodiscard]] std::span<const Interval> numbers() const {
    return std::span(root.values).subspan(3);
  }
};

/// True if b is in the part of a's chart in which a is the only solution.
bool is_in_reach(const ChartRoot& a, const ChartRoot& b) {
  const auto x = b.quaternion();
  const Interval& unit = x[static_cast<std::size_t>(a.chart)];
  if (contains_zero(unit)) return false;
  std::vector<Interval> there;
  for (int i = 0; i < 4; ++i)
    if (i != a.chart) there.push_back(x[static_cast<std::size_t>(i)] / unit);
  there.insert(there.end(), b.numbers().begin(), b.numbers().end());
  return a.root.is(there);
}

/// True if the quaternions are no multiples of each other, or another number differs.
bool certain_different(const ChartRoot& a, const ChartRoot& b) {
  const auto x = a.quaternion(), y = b.quaternion();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!contains_zero(x[i] * y[j] - x[j] * y[i])) return true;
  return !std::ranges::equal(a.numbers(), b.numbers(), [](const Interval& u, const Interval& v) {
    return !certain_disjoint(u, v);
  });
}

class PoseSearch {
 public:
  PoseSearch(const GoughLegs& legs, RootSettings settings, Observer* progress)
      : equations_(legs), settings_(std::move(settings)), progress_(progress) {}

  PoseList find() {
    if (!equations_.exist()) {
      list_.is_searched = false;
      return std::move(list_);
    }
    list_.is_complete = true;
    for (int chart = 0; chart < kChartsOfRotations && !list_.stopped_by; ++chart) search(chart);
    list_.is_complete = list_.is_complete && !list_.is_doubtful;
    for (const ChartRoot& known : roots_)
      list_.poses.push_back(equations_.pose_of(known.chart, known.root.values));
    return std::move(list_);
  }

 private:
  void search(int chart) {
    const std::size_t n = equations_.unknowns();
    Problem problem;
    problem.outer = equations_.ranges();
    const RootList found = search_roots(
        {problem, {0, 0, n, 0}, [&] { return std::make_unique<ChartSystem>(equations_, chart); }},
        std::vector<Interval>(n, Interval(0.0)), settings_, progress_);
    for (const Root& root : found.roots) add({chart, root});
    for (const auto& box : found.open) list_.open.push_back(equations_.pose_of(chart, box));
    list_.is_complete = list_.is_complete && found.is_complete;
    list_.is_doubtful = list_.is_doubtful || found.is_doubtful;
    list_.stopped_by = found.stopped_by;
    list_.boxes += found.boxes;
    list_.seconds += found.seconds;
    settings_.max_boxes -= std::min(settings_.max_boxes, found.boxes);
    settings_.time_limit -= found.seconds;
  }

  /// A pose on the border of charts is found in each of them.
  void add(ChartRoot found) {
    for (const ChartRoot& known : roots_) {
      if (known.chart == found.chart || certain_different(known, found)) continue;
      if (is_in_reach(known, found) || is_in_reach(found, known)) return;
      list_.is_doubtful = true;
      list_.open.push_back(equations_.pose_of(found.chart, found.root.values));
      return;
    }
    roots_.push_back(std::move(found));
  }

  const PoseEquations equations_;
  RootSettings settings_;
  Observer* const progress_;
  std::vector<ChartRoot> roots_;
  PoseList list_;
};

}  // namespace

PoseList search_poses(const GoughLegs& legs, RootSettings settings, Observer* progress) {
  return PoseSearch(legs, std::move(settings), progress).find();
}

}  // namespace regulus
