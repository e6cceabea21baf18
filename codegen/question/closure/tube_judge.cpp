// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/tube_judge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regulus::detail {

using cluster::ByteReader;
using cluster::ByteWriter;
using cluster::MalformedMessage;

namespace {

constexpr int kTrials = 8;
/// The radius is larger than the image of a tube without one, and then than its own image.
constexpr double kFirstGrowth = 1.5, kGrowth = 1.25;
/// The room that is left to the rounding of the verifier, and so that neighbours overlap.
constexpr double kRoom = 0.875;

bool has_room(const BranchTube& tube, const TubeImage& image, std::size_t i) {
  return std::fmax(image.radius[i], image.change[i]) <= kRoom * tube.radius[i];
}

bool has_room(const BranchTube& tube, const TubeImage& image) {
  for (std::size_t i = 0; i < tube.radius.size(); ++i)
    if (!has_room(tube, image, i)) return false;
  return has_one_solution(tube, image);
}

/// Returns for each variable the most that it adds to the first image of an unknown without room,
/// relative to all of it. A loop that has a tube needs no split of what moves it alone.
std::vector<double> impact_of(const TubeImage& first, const BranchTube& tube, const TubeImage& last,
                              const ClosedShape& shape) {
  std::vector<double> impact(shape.variables, 0.0);
  for (std::size_t i = 0; i < shape.unknowns; ++i) {
    if (has_room(tube, last, i)) continue;
    double all = 0;
    for (std::size_t k = 0; k < shape.variables; ++k) all += first.impact[i * shape.variables + k];
    for (std::size_t k = 0; k < shape.variables; ++k)
      if (all > 0) impact[k] = std::fmax(impact[k], first.impact[i * shape.variables + k] / all);
  }
  return impact;
}

}  // namespace

/// The box with the unknowns of the tube over the hull of the box and x₀.
SystemBoxes::Box TubeFinder::reach_of(const TubeTrial& trial,
                                      const std::vector<double>& radius) const {
  SystemBoxes::Box reach;
  for (std::size_t k = 0; k < shape_.variables; ++k)
    reach.push_back(hull(trial.box[k], Interval(trial.tube.at[k])));
  BranchTube tube = trial.tube;
  tube.radius = radius;
  const std::vector<Interval> unknowns = enclose(tube, reach);
  reach.insert(reach.end(), unknowns.begin(), unknowns.end());
  return reach;
}

/// The systems at x₀ and c.
std::vector<std::optional<SystemBoxes::System>> TubeFinder::centers_of(
    std::span<const TubeTrial> trials) {
  std::vector<SystemBoxes::Box> boxes;
  for (const TubeTrial& trial : trials) {
    SystemBoxes::Box& center = boxes.emplace_back();
    for (const double x : trial.tube.at) center.emplace_back(x);
    for (const double p : trial.tube.center) center.emplace_back(p);
  }
  system_.evaluate(boxes);
  std::vector<std::optional<SystemBoxes::System>> centers;
  for (std::size_t lane = 0; lane < trials.size(); ++lane) centers.push_back(system_.at(lane));
  return centers;
}

void TubeFinder::find(std::span<const TubeTrial> trials, std::span<TubeFinding> findings) {
  const std::size_t n = shape_.unknowns;
  const auto centers = centers_of(trials);
  std::vector<SystemBoxes::Box> boxes(trials.size());
  std::vector<std::vector<double>> radius(trials.size(), std::vector<double>(n, 0.0));
  std::vector<TubeImage> first(trials.size());
  std::vector<char> is_open(trials.size(), 1);
  for (int trial = 0; trial < kTrials; ++trial) {
    if (std::ranges::find(is_open, 1) == is_open.end()) return;
    for (std::size_t lane = 0; lane < trials.size(); ++lane)
      boxes[lane] = reach_of(trials[lane], radius[lane]);
    system_.evaluate(boxes, true);
    for (std::size_t lane = 0; lane < trials.size(); ++lane) {
      if (is_open[lane] == 0) continue;
      const auto over = system_.at(lane);
      bool is_within = true;
      for (std::size_t i = 0; i < n; ++i)
        is_within = is_within && certain_subset(boxes[lane][shape_.variables + i], ranges_[i]);
      TubeFinding& finding = findings[lane];
      finding.is_undefined = !over || !centers[lane];
      is_open[lane] = is_within && !finding.is_undefined ? 1 : 0;
      if (is_open[lane] == 0) continue;
      BranchTube tube = trials[lane].tube;
      tube.radius = radius[lane];
      const TubeImage image = image_of(
          tube, trials[lane].box, trials[lane].inverse,
          {centers[lane]->value, over->by_unknown, over->by_variable, centers[lane]->by_unknown,
           centers[lane]->by_variable, over->rates_by_unknown, over->rates_by_variable});
      if (trial == 0) first[lane] = image;
      finding.impact = impact_of(first[lane], tube, image, shape_);
      if (trial > 0 && has_room(tube, image)) {
        finding.tube = std::move(tube);
        is_open[lane] = 0;
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double least = least_radius_ * std::fmax(1.0, std::fabs(tube.center[i]));
        radius[lane][i] = std::fmax(least, (trial == 0 ? kFirstGrowth : kGrowth) * image.radius[i]);
        if (!std::isfinite(radius[lane][i])) is_open[lane] = 0;
      }
    }
  }
}

std::vector<std::optional<TubeFinder::Measured>> TubeFinder::measure(
    std::span<const TubeTrial> tubes) {
  const auto centers = centers_of(tubes);
  std::vector<SystemBoxes::Box> boxes;
  for (const TubeTrial& trial : tubes) boxes.push_back(reach_of(trial, trial.tube.radius));
  system_.evaluate(boxes, true);
  std::vector<std::optional<Measured>> measured(tubes.size());
  for (std::size_t lane = 0; lane < tubes.size(); ++lane) {
    auto over = system_.at(lane);
    if (!over || !centers[lane]) continue;
    const SystemBoxes::System& center = *centers[lane];
    std::vector<double> middle;
    for (const Interval& entry : center.by_unknown) middle.push_back(mid(entry));
    auto inverse = approx_inverse_of(middle, shape_.unknowns);
    if (!inverse) continue;
    TubeImage image =
        image_of(tubes[lane].tube, tubes[lane].box, *inverse,
                 {center.value, over->by_unknown, over->by_variable, center.by_unknown,
                  center.by_variable, over->rates_by_unknown, over->rates_by_variable});
    if (!has_one_solution(tubes[lane].tube, image)) continue;
    measured[lane] = {std::move(*inverse), std::move(image), std::move(*over), center.by_unknown};
  }
  return measured;
}

void TubeJudge::judge(std::span<const Box> boxes, std::span<TubeFinding> findings, double) {
  const ClosedShape& shape = question_.shape;
  const std::vector<char> outside = system_.are_outside(boxes);
  std::vector<std::vector<double>> places;
  std::vector<std::size_t> of;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
    findings[lane].is_outside = outside[lane] != 0;
    if (findings[lane].is_outside) continue;
    std::vector<double>& place = places.emplace_back();
    for (std::size_t k = 0; k < shape.variables; ++k) place.push_back(mid(boxes[lane][k]));
    of.push_back(lane);
  }
  const auto found = track(system_, shape, question_.start, places);
  std::vector<TubeTrial> trials;
  std::vector<std::size_t> lanes;
  for (std::size_t i = 0; i < found.size(); ++i) {
    findings[of[i]].is_lost = !found[i];
    if (!found[i]) continue;
    const Box& box = boxes[of[i]];
    trials.push_back({Box(box.begin(), box.begin() + std::ptrdiff_t(shape.variables)),
                      {found[i]->at.variables, found[i]->at.unknowns, found[i]->slopes, {}},
                      found[i]->inverse});
    lanes.push_back(of[i]);
  }
  if (trials.empty()) return;
  std::vector<TubeFinding> tubes(trials.size());
  finder_.find(trials, tubes);
  measure_uncertainty(trials, tubes);
  for (std::size_t i = 0; i < trials.size(); ++i) findings[lanes[i]] = std::move(tubes[i]);
}

/// Halving the motion's ranges leads to no tube where there is none at their middles.
void TubeJudge::measure_uncertainty(std::span<const TubeTrial> trials,
                                    std::span<TubeFinding> tubes) {
  const ClosedShape& shape = question_.shape;
  if (shape.parameters == shape.variables) return;
  std::vector<TubeTrial> still;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (tubes[i].tube || tubes[i].is_undefined) continue;
    TubeTrial& trial = still.emplace_back(trials[i]);
    for (std::size_t k = 0; k < shape.parameters; ++k) trial.box[k] = Interval(trial.tube.at[k]);
    of.push_back(i);
  }
  if (still.empty()) return;
  std::vector<TubeFinding> found(still.size());
  finder_.find(still, found);
  for (std::size_t i = 0; i < still.size(); ++i) tubes[of[i]].is_too_uncertain = !found[i].tube;
}

void TubeJudge::put(ByteWriter& to, const TubeFinding& finding) {
  to.put(finding.is_outside);
  to.put(finding.is_undefined);
  to.put(finding.is_lost);
  to.put(finding.is_too_uncertain);
  to.put_list(std::span<const double>(finding.impact));
  to.put(finding.tube.has_value());
  if (!finding.tube) return;
  for (const auto* list :
       {&finding.tube->at, &finding.tube->center, &finding.tube->slopes, &finding.tube->radius})
    to.put_list(std::span<const double>(*list));
}

TubeFinding TubeJudge::take(ByteReader& from, const ClosureQuestion& question) {
  const std::size_t n = question.shape.unknowns, m = question.shape.variables;
  TubeFinding finding;
  finding.is_outside = from.take_flag();
  finding.is_undefined = from.take_flag();
  finding.is_lost = from.take_flag();
  finding.is_too_uncertain = from.take_flag();
  finding.impact = from.take_list<double>();
  const std::size_t impacts = finding.impact.size();
  if (impacts != 0 && impacts != m) throw MalformedMessage();
  if (!from.take_flag()) return finding;
  BranchTube& tube = finding.tube.emplace();
  tube.at = from.take_list_of<double>(m);
  tube.center = from.take_list_of<double>(n);
  tube.slopes = from.take_list_of<double>(n * m);
  tube.radius = from.take_list_of<double>(n);
  return finding;
}

}  // namespace regulus::detail
