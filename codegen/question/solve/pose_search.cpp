// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/pose_search.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "codegen/question/solve/followed_boxes.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/solutions/pose_equations.hpp"
#include "runtime/solutions/pose_narrowing.hpp"

namespace regulus::detail {
namespace {

/// The equations of one chart.
class ChartSystem final : public RootSystem {
 public:
  ChartSystem(const PoseEquations& equations, int chart)
      : equations_(equations),
        chart_(chart),
        rows_(equations.rows()),
        in_(equations.unknowns()),
        out_(static_cast<std::size_t>(rows_.all())),
        exact_(equations.have_deviations() ? static_cast<std::size_t>(rows_.all()) : 0) {}

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Box& box = boxes[std::min(lane, boxes.size() - 1)];
      for (std::size_t k = 0; k < box.size(); ++k) in_.set(k, lane, box[k]);
    }
    equations_.evaluate(chart_, in_.data(), out_.data(), has_rates);
    has_rates_ = has_rates;
    points_.clear();
    if (!equations_.have_deviations() || !std::ranges::all_of(boxes, is_point)) return;
    points_.assign(boxes.begin(), boxes.end());
    equations_.evaluate_exact(chart_, in_.data(), exact_.data(), false);
  }

  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override {
    const auto take = [&](std::vector<Interval>& values, const IntervalRows& from, int first,
                          int last) {
      values.reserve(static_cast<std::size_t>(last - first));
      for (int i = first; i < last; ++i)
        values.push_back(from.get(static_cast<std::size_t>(i), lane));
    };
    Values values;
    take(values.value, out_, 0, rows_.derivatives());
    take(values.by_unknown, out_, rows_.derivatives(), rows_.extras());
    take(values.also, out_, rows_.extras(), rows_.rates());
    if (has_rates_) take(values.rates_by_unknown, out_, rows_.rates(), rows_.all());
    if (points_.empty()) return values;
    take(values.core, exact_, 0, rows_.derivatives());
    PoseEquations::Spread spread = equations_.spread_at(chart_, points_[lane]);
    values.core.back() += spread.bend;
    values.by_datum = std::move(spread.by_deviation);
    values.data.assign(equations_.deviations().begin(), equations_.deviations().end());
    return values;
  }

 private:
  const PoseEquations& equations_;
  const int chart_;
  const PoseRows rows_;
  IntervalRows in_, out_, exact_;
  std::vector<Box> points_;  ///< if the boxes are points, and there are deviations
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
      : equations_(std::make_shared<const PoseEquations>(legs)),
        settings_(std::move(settings)),
        progress_(progress) {}

  PoseList find() {
    if (!equations_->exist()) {
      list_.is_searched = false;
      return std::move(list_);
    }
    list_.is_complete = true;
    for (int chart = 0; chart < kChartsOfRotations && !list_.stopped_by; ++chart) search(chart);
    list_.is_complete = list_.is_complete && !list_.is_doubtful;
    for (const ChartRoot& known : roots_)
      list_.poses.push_back(equations_->pose_of(known.chart, known.root.values));
    return std::move(list_);
  }

 private:
  void search(int chart) {
    const std::size_t n = equations_->unknowns();
    Problem problem;
    problem.outer = equations_->ranges();
    const RootSystems systems = systems_of_chart(equations_, chart);
    const RootList found = search_roots(
        systems.question(problem), std::vector<Interval>(n, Interval(0.0)), settings_, progress_);
    for (const Root& root : found.roots) add({chart, root});
    for (const auto& box : found.open) list_.open.push_back(equations_->pose_of(chart, box));
    list_.is_complete = list_.is_complete && found.is_complete;
    list_.is_doubtful = list_.is_doubtful || found.is_doubtful;
    list_.stopped_by = found.stopped_by;
    list_.boxes += found.boxes;
    list_.seconds += found.seconds;
    leave_rest(settings_, found);
  }

  /// A pose on the border of charts is found in each of them.
  void add(ChartRoot found) {
    for (const ChartRoot& known : roots_) {
      if (known.chart == found.chart || certain_different(known, found)) continue;
      if (is_in_reach(known, found) || is_in_reach(found, known)) return;
      list_.is_doubtful = true;
      list_.open.push_back(equations_->pose_of(found.chart, found.root.values));
      return;
    }
    roots_.push_back(std::move(found));
  }

  const std::shared_ptr<const PoseEquations> equations_;
  RootSettings settings_;
  Observer* const progress_;
  std::vector<ChartRoot> roots_;
  PoseList list_;
};

using Rotation = std::array<Interval, 4>;

bool may_be_same(const Rotation& p, const Rotation& q) {
  return std::ranges::equal(
      p, q, [](const Interval& a, const Interval& b) { return !certain_disjoint(a, b); });
}

Rotation opposite(const Rotation& q) { return {-q[0], -q[1], -q[2], -q[3]}; }

bool may_touch(const GoughPose& a, const GoughPose& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (certain_disjoint(a.position[i], b.position[i])) return false;
  return may_be_same(a.rotation, b.rotation) || may_be_same(a.rotation, opposite(b.rotation));
}

/// Encloses both, with the sign of a's rotation.
GoughPose hull_of(const GoughPose& a, const GoughPose& b) {
  GoughPose both;
  const bool is_opposite = !may_be_same(a.rotation, b.rotation);
  const Rotation q = is_opposite ? opposite(b.rotation) : b.rotation;
  for (std::size_t i = 0; i < 3; ++i) both.position[i] = hull(a.position[i], b.position[i]);
  for (std::size_t i = 0; i < 4; ++i) both.rotation[i] = hull(a.rotation[i], q[i]);
  return both;
}

GoughPose hull_of_all(const std::vector<GoughPose>& poses) {
  return std::accumulate(poses.begin() + 1, poses.end(), poses.front(), hull_of);
}

/// At a pose of some legs of the set, the leg of `at` from anchor to anchor has a square from ρ² + this.
std::array<Interval, 6> deviations_of(const GoughLegs& at, const GoughLegs& legs) {
  std::array<Interval, 6> result;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto shift = [&](const GoughLegs::Anchors& all, const GoughLegs::Anchors& one) {
      std::array<Interval, 3> gap;
      for (std::size_t k = 0; k < 3; ++k) gap[k] = abs(all[i][k] - one[i][k]);
      return sqrt(sqr(gap[0]) + sqr(gap[1]) + sqr(gap[2])).hi;
    };
    const double slack = add_ru(shift(legs.base, at.base), shift(legs.platform, at.platform));
    const Interval length = abs(legs.length[i]) + Interval(-slack, slack);
    result[i] = sqr(length) - sqr(at.length[i]);
  }
  return result;
}

class PoseFollowing {
 public:
  PoseFollowing(const GoughLegs& at, const GoughLegs& legs, RootSettings settings,
                Observer* progress)
      : both_(std::make_shared<const FollowedEquations>(at, legs)),
        equations_(both_->first),
        legs_(legs),
        settings_(std::move(settings)),
        progress_(progress) {}

  PoseTubes follow(const std::vector<GoughPose>& poses) {
    result_.tubes.resize(poses.size());
    result_.is_searched = equations_.exist() && both_->all.exist();
    if (!result_.is_searched) return std::move(result_);
    for (; searched_ < kChartsOfRotations && !result_.stopped_by; ++searched_) search(searched_);
    // A chart that was not searched is open all over.
    const bool is_whole = searched_ == kChartsOfRotations;
    for (std::size_t i = 0; is_whole && i < poses.size(); ++i)
      if (const auto parts = reach_from(poses[i], boxes_, result_.open, may_touch))
        result_.tubes[i] = narrow_poses(legs_, hull_of_all(*parts)).poses;
    result_.are_all = is_whole && result_.open.empty();
    return std::move(result_);
  }

 private:
  void search(int chart) {
    const auto undecided = search_in_levels(
        equations_.ranges(), settings_,
        [this, chart](const std::vector<Interval>& box) { return search(chart, box); });
    for (const auto& box : undecided) result_.open.push_back(equations_.pose_of(chart, box));
  }

  /// Returns what is not decided.
  std::vector<std::vector<Interval>> search(int chart, const std::vector<Interval>& box) {
    if (result_.stopped_by) return {box};
    const std::size_t n = equations_.unknowns();
    Problem problem;
    problem.outer = box;
    const RootSystems systems = systems_of_chart(both_, chart);
    RootList found = search_roots(systems.question(problem),
                                  std::vector<Interval>(n, Interval(0.0)), settings_, progress_);
    for (const auto& part : found.regular)
      if (const auto narrow = narrow_poses(legs_, equations_.pose_of(chart, part)).poses)
        boxes_.push_back(*narrow);
    std::erase_if(found.open, [&](const auto& part) {
      const NarrowedPoses narrow = narrow_poses(legs_, equations_.pose_of(chart, part));
      if (narrow.poses && narrow.is_regular) boxes_.push_back(*narrow.poses);
      return !narrow.poses || narrow.is_regular;
    });
    result_.stopped_by = found.stopped_by;
    result_.boxes += found.boxes;
    result_.seconds += found.seconds;
    leave_rest(settings_, found);
    return std::move(found.open);
  }

  const std::shared_ptr<const FollowedEquations> both_;
  const PoseEquations& equations_;
  const GoughLegs& legs_;
  RootSettings settings_;
  Observer* const progress_;
  std::vector<GoughPose> boxes_;  ///< with the open ones they hold all poses of all legs
  int searched_ = 0;              ///< charts
  PoseTubes result_;
};

}  // namespace

RootSystems systems_of_chart(std::shared_ptr<const PoseEquations> equations, int chart) {
  return {std::size_t(chart), equations->unknowns(),
          [equations, chart] { return std::make_unique<ChartSystem>(*equations, chart); }};
}

FollowedEquations::FollowedEquations(const GoughLegs& at, const GoughLegs& legs)
    : first(at, deviations_of(at, legs)), all(legs, first) {}

RootSystems systems_of_chart(std::shared_ptr<const FollowedEquations> equations, int chart) {
  return {std::size_t(kChartsOfRotations + chart), equations->first.unknowns(),
          [equations, chart] { return std::make_unique<ChartSystem>(equations->first, chart); },
          [equations, chart] { return std::make_unique<ChartSystem>(equations->all, chart); }};
}

PoseList search_poses(const GoughLegs& legs, RootSettings settings, Observer* progress) {
  return PoseSearch(legs, std::move(settings), progress).find();
}

PoseTubes follow_poses(const GoughLegs& at, const GoughLegs& legs,
                       const std::vector<GoughPose>& poses, RootSettings settings,
                       Observer* progress) {
  return PoseFollowing(at, legs, std::move(settings), progress).follow(poses);
}

}  // namespace regulus::detail
