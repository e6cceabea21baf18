// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/pose_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "runtime/verifier/box_search.hpp"
#include "runtime/verifier/pose_equations.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kPlaces = 3, kParts = 4;
constexpr double kScaleOfPoses = 0x1p-32;  ///< a part of the range
constexpr double kNearPose =
    0x1p-4;  ///< a rotation in a box as narrow is narrowed by the legs, too
constexpr double kBeyondChart =
    1.25;  ///< a solution with a part beyond this is in no box of a chart

Box box_of(const SolutionBox& solution) {
  Box box;
  for (std::size_t i = 0; i < solution.middle.size(); ++i)
    box.push_back(point(solution.middle[i]) + Interval{-solution.radius[i], solution.radius[i]});
  return box;
}

std::vector<double> middles(const Box& box) {
  std::vector<double> result;
  for (const Interval x : box) result.push_back(mid(x));
  return result;
}

Box negative_turn(Box pose) {
  for (std::size_t i = kPlaces; i < pose.size(); ++i) pose[i] = -pose[i];
  return pose;
}

/// True only if all poses of the box, with one of the two signs of their quaternions, are in the line.
bool is_pose_in(const Box& pose, const SolutionLine& line) {
  return is_in(pose, line.values) || is_in(negative_turn(pose), line.values);
}

/// A chart with its search.
struct Chart {
  PoseChart equations;
  BoxSearch search, legs;  ///< of the few equations, and of the legs as they are
  Evaluation place, pose;
  std::vector<double> scale{};
  std::vector<Box> reaches{};        ///< of lines, in the unknowns of `legs`
  std::vector<std::size_t> lines{};  ///< whose reaches these are

  Chart(PoseChart chart, const Box& of_legs, WorkClock& clock, const Options& options,
        Verification& result)
      : equations(std::move(chart)),
        search(equations.question, {}, equations.places, clock, options, result),
        legs(equations.legs, {}, of_legs, clock, options, result),
        place(equations.question, {equations.place.begin(), equations.place.end()}),
        pose(equations.legs, {equations.pose.begin(), equations.pose.end()}),
        places_(of_legs) {
    search.set_range(equations.range);
    legs.set_range(equations.range_of_legs);
    for (const Interval range : equations.range_of_legs)
      scale.push_back(kScaleOfPoses * (range.hi - range.lo));
  }
  Chart(const Chart&) = delete;
  Chart& operator=(const Chart&) = delete;

  /// Returns a small box with exactly one pose, in the unknowns of the legs, at each of the places.
  [[nodiscard]] std::optional<SolutionBox> solution_near(const std::vector<double>& start) {
    return legs.test().solution_near(places_, start, scale);
  }

  /// Returns x, y, z and the unit quaternion; empty: not certain.
  [[nodiscard]] Box pose_of(const Box& unknowns) {
    Box result;
    if (!pose.run(joined(places_, unknowns))) return result;
    for (const NodeId node : equations.pose) result.push_back(pose.value(node));
    return result;
  }

  /// The unknowns of the legs at the poses of a box of the search; empty: not certain.
  [[nodiscard]] Box unknowns_of_legs(const Box& box) {
    Box result;
    if (!place.run(joined(equations.places, box))) return result;
    result.assign(box.begin(), box.begin() + kPlaces);
    for (const NodeId node : equations.place) result.push_back(place.value(node));
    return result;
  }

  /// BoxSearch::Rest for boxes of the search.
  [[nodiscard]] bool has_rest(Box& box) {
    return has_rest(box, [this](const Box& near) { return is_in_one(near, reaches); });
  }

  /// The same while poses are followed: known are those that are regular and within a line.
  [[nodiscard]] bool has_rest(Box& box, const std::vector<SolutionLine>& within) {
    return has_rest(box, [&](const Box& near) {
      const Box at = pose_of(near);
      return !at.empty() && std::ranges::any_of(within, [&](const SolutionLine& line) {
        return is_pose_in(at, line);
      }) && legs.test().is_regular(places_, near);
    });
  }

 private:
  static Box joined(Box places, const Box& unknowns) {
    places.insert(places.end(), unknowns.begin(), unknowns.end());
    return places;
  }

  /// `are_known`: says of a box of the legs' unknowns that all poses in it are.
  template <class AreKnown>
  [[nodiscard]] bool has_rest(Box& box, const AreKnown& are_known) {
    Box near = unknowns_of_legs(box);
    if (near.empty()) return true;
    if (are_known(near)) return false;
    if (std::ranges::any_of(std::span(box).first(kPlaces),
                            [](const Interval x) { return x.hi - x.lo > kNearPose; }))
      return true;
    if (!legs.test().narrow_to_solutions(places_, near) || are_known(near)) return false;
    std::copy_n(near.begin(), kPlaces, box.begin());
    return true;
  }

  const Box& places_;  ///< of the uncertain quantities and errors
};

/// A pose that is certain.
struct ProvedPose {
  std::size_t chart;
  Box unknowns;  ///< of the legs: it is the only one there
  Box pose;
};

/// True only if the quaternions are no multiples of each other, or the places differ.
bool are_different(const Box& a, const Box& b) {
  if (are_disjoint(std::span(a).first(kPlaces), std::span(b).first(kPlaces))) return true;
  for (std::size_t i = kPlaces; i < kPlaces + kParts; ++i)
    for (std::size_t j = kPlaces; j < i; ++j)
      if (!contains(a[i] * b[j] - a[j] * b[i], 0.0)) return true;
  return false;
}

class PoseSearch {
 public:
  PoseSearch(Lines& lines, const Question& q, const Box& places, const Options& options,
             Verification& result)
      : lines_(lines), claim_(*q.solutions), result_(result), clock_(options, result) {
    for (PoseChart& chart : form_pose_equations(q, places))
      charts_.push_back(std::make_unique<Chart>(std::move(chart), places, clock_, options, result));
  }

  void check() {
    for (std::size_t k = 0; k < claim_.solutions.size(); ++k) {
      const SolutionLine& line = claim_.solutions[k];
      lines_.name_line(line.line);
      prove(line, claim_.from.empty() ? middles(line.values) : claim_.from[k]);
    }
    lines_.name_line(0);
    for (std::size_t c = 0; c < charts_.size() && claim_.verdict != format::kIncomplete; ++c)
      charts_[c]->search.search([this, c](Box& box) { return charts_[c]->has_rest(box); },
                                [this, c](const Box& box) { look_for_other(c, box); });
    result_.real_roots = result_.roots = proved_.size();
  }

  /// Shows that at each place all poses are regular and within the lines, which are apart.
  void follow() {
    const std::vector<SolutionLine>& all = claim_.solutions;
    for (std::size_t k = 0; k < all.size(); ++k) {
      lines_.name_line(all[k].line);
      for (std::size_t i = 0; i < k; ++i)
        if (!are_different(all[k].values, all[i].values))
          throw Unfinished("the pose may be that of line " + std::to_string(all[i].line));
    }
    lines_.name_line(0);
    for (const std::unique_ptr<Chart>& chart : charts_)
      chart->search.search([&](Box& box) { return chart->has_rest(box, all); }, [](const Box&) {},
                           kFollowed);
  }

 private:
  /// Shows that a pose is within the line, and is that of no other line. It is looked for from `start`.
  void prove(const SolutionLine& line, const std::vector<double>& start) {
    clock_.tick();
    std::size_t c = 0;
    for (std::size_t part = 1; part < kParts; ++part)
      if (std::fabs(start[kPlaces + part]) > std::fabs(start[kPlaces + c])) c = part;
    Chart& chart = *charts_[c];
    const auto found = chart.solution_near(unknowns_at(start, c));
    if (!found) throw Unfinished("no pose was found near this line");
    ProvedPose proved{c, box_of(*found), {}};
    proved.pose = chart.pose_of(proved.unknowns);
    if (proved.pose.empty()) throw Unfinished("the pose has no certain values");
    if (!is_pose_in(proved.pose, line)) {
      if (are_disjoint(proved.pose, line.values) &&
          are_disjoint(negative_turn(proved.pose), line.values))
        throw Rejection("no pose was found within this line");
      throw Unfinished("the pose is not shown to be within this line");
    }
    for (std::size_t k = 0; k < proved_.size(); ++k) require_other(proved, k);
    proved_.push_back(std::move(proved));
    for (std::size_t other = 0; other < charts_.size(); ++other) add_reach(other);
  }

  /// The unknowns of the legs at a pose.
  static std::vector<double> unknowns_at(const std::vector<double>& at, std::size_t c) {
    std::vector<double> result;
    for (std::size_t part = 0; part < kParts; ++part)
      if (part != c) result.push_back(at[kPlaces + part] / at[kPlaces + c]);
    result.insert(result.end(), at.begin(), at.begin() + kPlaces);
    return result;
  }

  void require_other(const ProvedPose& proved, std::size_t k) const {
    if (are_different(proved.pose, proved_[k].pose)) return;
    const std::string line = std::to_string(claim_.solutions[k].line);
    const Chart& chart = *charts_[proved.chart];
    const auto at = std::ranges::find(chart.lines, k);
    if (at != chart.lines.end() &&
        is_in(proved.unknowns, chart.reaches[std::size_t(at - chart.lines.begin())]))
      throw Rejection("the pose is that of line " + line);
    throw Unfinished("the pose may be that of line " + line);
  }

  /// Adds the reach of the last pose in a chart, if it may be there.
  void add_reach(std::size_t c) {
    const ProvedPose& proved = proved_.back();
    Chart& chart = *charts_[c];
    const Interval unit = proved.pose[kPlaces + c];
    if (contains(unit, 0.0)) return;
    Box there;
    for (std::size_t part = 0; part < kParts; ++part)
      if (part != c) there.push_back(proved.pose[kPlaces + part] / unit);
    for (const Interval x : there)
      if (mig(x) > kBeyondChart) return;
    there.insert(there.end(), proved.unknowns.begin() + kPlaces, proved.unknowns.end());
    std::vector<double> radius;
    for (const Interval x : there) radius.push_back(up(mag(x - point(mid(x)))));
    auto reach = chart.legs.reach_of(middles(there), radius);
    if (!reach || !is_in(there, *reach)) {
      for (double& r : radius) r = up(2 * r);
      reach = chart.legs.reach_of(middles(there), radius);
    }
    if (!reach || !is_in(there, *reach)) return;
    chart.reaches.push_back(std::move(*reach));
    chart.lines.push_back(proved_.size() - 1);
  }

  /// Rejects the claim if a pose is found near the box that is in no line.
  void look_for_other(std::size_t c, const Box& box) {
    Chart& chart = *charts_[c];
    const Box near = chart.unknowns_of_legs(box);
    const auto found = near.empty() ? std::nullopt : chart.solution_near(middles(near));
    if (!found) return;
    const Box pose = chart.pose_of(box_of(*found));
    if (pose.empty()) return;
    const bool is_other = std::ranges::all_of(
        proved_, [&](const ProvedPose& known) { return are_different(pose, known.pose); });
    if (is_other)
      throw Rejection("there is another pose, near x = " + std::to_string(mid(pose[0])) + ", y = " +
                      std::to_string(mid(pose[1])) + ", z = " + std::to_string(mid(pose[2])));
  }

  Lines& lines_;
  const SolutionLines& claim_;
  Verification& result_;
  WorkClock clock_;
  std::vector<std::unique_ptr<Chart>> charts_;
  std::vector<ProvedPose> proved_;  ///< by line
};

}  // namespace

void search_poses(Lines& lines, const Question& question, const Box& places, const Options& options,
                  Verification& result) {
  const SolutionLines& claim = *question.solutions;
  if (claim.from.empty()) return PoseSearch(lines, question, places, options, result).check();
  Box middle;
  for (const Interval x : places) middle.push_back(point(mid(x)));
  PoseSearch(lines, question, middle, options, result).check();
  PoseSearch(lines, question, places, options, result).follow();
}

}  // namespace regulus::verifier
