// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_judge.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

/// Returns how much each variable changes the derivatives of the branch, relative to the tube.
std::vector<double> impact_of(const BranchTube& tube, const TubeImage& image, std::size_t m) {
  std::vector<double> impact(m, 0.0);
  for (std::size_t i = 0; i < tube.radius.size(); ++i)
    for (std::size_t k = 0; k < m; ++k)
      impact[k] = std::fmax(impact[k], image.impact[i * m + k] / tube.radius[i]);
  return impact;
}

std::vector<double> corner_towards(const std::vector<double>& growth,
                                   std::span<const Interval> box) {
  std::vector<double> corner;
  for (std::size_t k = 0; k < growth.size(); ++k)
    corner.push_back(growth[k] == 0 ? mid(box[k]) : growth[k] > 0 ? box[k].hi : box[k].lo);
  return corner;
}

constexpr int kSteps = 8;

/// At x₀ the solution c + ρ has 0 = KΦ(x₀, c) + (I + E)ρ, so that |ρ| ≤ |KΦ(x₀, c)| + |E||ρ|, and
/// |ρ| < r to begin with.
std::vector<double> near_center(const BranchTube& tube, const TubeImage& image) {
  std::vector<double> near = tube.radius;
  const std::size_t n = near.size();
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<double> last = near;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = image.offset[i];
      for (std::size_t j = 0; j < n; ++j)
        sum = add_ru(sum, mul_ru(image.spread[i * n + j], last[j]));
      near[i] = std::fmin(last[i], sum);
    }
  }
  return near;
}

}  // namespace

bool holds_solutions_of(const BranchTube& leaf, const BranchTube& tube,
                        std::span<const double> near) {
  std::vector<Interval> place, solution;
  for (const double x : tube.at) place.emplace_back(x);
  for (std::size_t i = 0; i < near.size(); ++i)
    solution.push_back(Interval(tube.center[i]) + Interval(-near[i], near[i]));
  return certain_holds(leaf, place, near.empty() ? enclose(tube, place) : solution);
}

/// Encloses f over each of 1…8 tubes. `findings`: are told of these tubes; empty: nothing is.
std::vector<Interval> ValueJudge::values_of(std::span<const TubeTrial> tubes,
                                            std::span<ValueFinding* const> findings) {
  std::vector<Interval> values;
  const auto measured = finder_.measure(tubes);
  const std::size_t m = question_.closure.shape.variables;
  for (std::size_t lane = 0; lane < tubes.size(); ++lane) {
    const BranchTube& tube = tubes[lane].tube;
    if (question_.value.is_distance()) {
      values.push_back(question_.value.distance(tube, tubes[lane].box));
      if (findings.empty() || !measured[lane]) continue;
      findings[lane]->impact = question_.value.impact_on_distance(measured[lane]->image, m);
      findings[lane]->near_center = near_center(tube, measured[lane]->image);
      continue;
    }
    if (!measured[lane]) {
      values.emplace_back(-kInfinity, kInfinity);
      continue;
    }
    if (question_.value.singular_values() != nullptr) {
      values.push_back(singular_value_of(tubes[lane], *measured[lane],
                                         findings.empty() ? nullptr : findings[lane]));
      continue;
    }
    const BranchRates rates(tube, measured[lane]->image, measured[lane]->inverse,
                            measured[lane]->over.by_unknown);
    values.push_back(question_.value.largest(rates, measured[lane]->over));
    if (findings.empty()) continue;
    findings[lane]->impact = impact_of(tube, measured[lane]->image, m);
    findings[lane]->near_center = near_center(tube, measured[lane]->image);
  }
  return values;
}

/// `finding`: the tube is one of a box, and its upper end counts; null: its lower end.
Interval ValueJudge::singular_value_of(const TubeTrial& trial, const TubeFinder::Measured& measured,
                                       ValueFinding* finding) const {
  const SingularValues& values = *question_.value.singular_values();
  if (finding == nullptr) return {values.attained(measured), kInfinity};
  SingularValueFinding found = values.bound(trial, measured);
  finding->growth = std::move(found.growth);
  finding->near_center = near_center(trial.tube, measured.image);
  finding->impact = found.impact.empty()
                        ? impact_of(trial.tube, measured.image, question_.closure.shape.variables)
                        : std::move(found.impact);
  return {-kInfinity, found.upper};
}

void ValueJudge::judge(std::span<const Box> boxes, std::span<ValueFinding> findings,
                       double horizon) {
  const std::size_t m = question_.closure.shape.variables;
  std::vector<TubeFinding> found(boxes.size());
  tubes_.judge(boxes, found, horizon);
  std::vector<TubeTrial> tubes;
  std::vector<ValueFinding*> of;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
    findings[lane].tube = std::move(found[lane]);
    const auto& tube = findings[lane].tube.tube;
    if (!tube) continue;
    const Box& box = boxes[lane];
    tubes.push_back({Box(box.begin(), box.begin() + std::ptrdiff_t(m)), *tube, {}});
    of.push_back(&findings[lane]);
  }
  if (tubes.empty()) return;
  const std::vector<Interval> values = values_of(tubes, of);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    if (values[i].hi < kInfinity) of[i]->upper = values[i].hi;
    if (values[i].lo > -kInfinity) of[i]->lower = values[i].lo;
  }
  if (horizon < kInfinity) judge_middles(tubes, of);
}

/// A variable whose only value is no double keeps its enclosure.
SystemBoxes::Box ValueJudge::middle_of(const Box& box, const std::vector<double>& at) const {
  Box place;
  for (std::size_t k = 0; k < at.size(); ++k)
    place.push_back(question_.problem.inner[k] ? Interval(at[k]) : box[k]);
  return place;
}

/// Returns a place of the box where f may be large, and the unknowns there, nearly.
BranchPoint ValueJudge::place_in(const TubeTrial& trial, const ValueFinding& finding) const {
  const bool is_distance = question_.value.is_distance();
  if (!is_distance && finding.growth.empty()) return {trial.tube.at, trial.tube.center};
  BranchPoint point{is_distance ? question_.value.farthest(trial.tube, trial.box)
                                : corner_towards(finding.growth, trial.box),
                    {}};
  std::vector<Interval> place;
  for (std::size_t k = 0; k < point.variables.size(); ++k) {
    const std::optional<Interval>& inner = question_.problem.inner[k];
    if (inner) point.variables[k] = std::clamp(point.variables[k], inner->lo, inner->hi);
    place.emplace_back(point.variables[k]);
  }
  for (const Interval& p : enclose(trial.tube, place)) point.unknowns.push_back(mid(p));
  return point;
}

/// Encloses f where the tubes have their centres, or where it may be large.
void ValueJudge::judge_middles(std::span<const TubeTrial> tubes,
                               std::span<ValueFinding* const> findings) {
  std::vector<BranchPoint> near;
  for (std::size_t i = 0; i < tubes.size(); ++i) near.push_back(place_in(tubes[i], *findings[i]));
  const auto settled = settle(system_, question_.closure.shape, near);
  std::vector<TubeTrial> middles, proved;
  std::vector<ValueFinding*> of, of_proved;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    if (!settled[i]) continue;
    const BranchPoint& at = settled[i]->at;
    middles.push_back({middle_of(tubes[i].box, at.variables),
                       {at.variables, at.unknowns, settled[i]->slopes, {}},
                       settled[i]->inverse});
    of.push_back(findings[i]);
  }
  if (middles.empty()) return;
  std::vector<TubeFinding> found(middles.size());
  finder_.find(middles, found);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    if (!found[i].tube) continue;
    proved.push_back({middles[i].box, *found[i].tube, {}});
    of_proved.push_back(of[i]);
  }
  if (proved.empty()) return;
  const std::vector<Interval> values = values_of(proved, {});
  for (std::size_t i = 0; i < proved.size(); ++i) {
    if (!(values[i].lo > -kInfinity)) continue;
    of_proved[i]->middle = proved[i].tube;
    of_proved[i]->attained = values[i].lo;
  }
}

void ValueJudge::put(cluster::ByteWriter& to, const ValueFinding& finding) {
  TubeJudge::put(to, finding.tube);
  TubeFinding middle;
  middle.tube = finding.middle;
  TubeJudge::put(to, middle);
  to.put(finding.upper);
  to.put(finding.lower);
  to.put(finding.attained);
  to.put_list(std::span<const double>(finding.impact));
  to.put_list(std::span<const double>(finding.near_center));
}

ValueFinding ValueJudge::take(cluster::ByteReader& from, const ValueQuestion& question) {
  ValueFinding finding;
  finding.tube = TubeJudge::take(from, question.closure);
  finding.middle = TubeJudge::take(from, question.closure).tube;
  finding.upper = from.take<double>();
  finding.lower = from.take<double>();
  finding.attained = from.take<double>();
  finding.impact = from.take_list<double>();
  finding.near_center = from.take_list<double>();
  const bool is_near = std::ranges::all_of(finding.near_center, [](double r) { return r >= 0; });
  if (!is_near ||
      (!finding.near_center.empty() &&
       finding.near_center.size() != question.closure.shape.unknowns) ||
      std::isnan(finding.upper) || std::isnan(finding.lower) || std::isnan(finding.attained) ||
      (!finding.impact.empty() && finding.impact.size() != question.closure.shape.variables))
    throw cluster::MalformedMessage();
  return finding;
}

}  // namespace regulus::detail
