// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_judge.hpp"

#include <algorithm>
#include <cmath>

namespace regulus {
namespace {

/// Returns how much each variable changes the derivatives of the branch, relative to the tube.
std::vector<double> impact_of(const BranchTube& tube, const TubeImage& image, std::size_t m) {
  std::vector<double> impact(m, 0.0);
  for (std::size_t i = 0; i < tube.radius.size(); ++i)
    for (std::size_t k = 0; k < m; ++k)
      impact[k] = std::fmax(impact[k], image.impact[i * m + k] / tube.radius[i]);
  return impact;
}

}  // namespace

/// Encloses f over each of 1…8 tubes.
std::vector<Interval> ValueJudge::values_of(std::span<const TubeTrial> tubes,
                                            std::vector<std::vector<double>>* impact) {
  std::vector<Interval> values;
  const auto measured = finder_.measure(tubes);
  for (std::size_t lane = 0; lane < tubes.size(); ++lane) {
    if (!measured[lane]) {
      values.emplace_back(-kInfinity, kInfinity);
      continue;
    }
    const BranchTube& tube = tubes[lane].tube;
    const BranchRates rates(tube, measured[lane]->image, measured[lane]->inverse,
                            measured[lane]->over.by_unknown);
    values.push_back(question_.value.largest(rates, measured[lane]->over));
    if (impact != nullptr)
      (*impact)[lane] = impact_of(tube, measured[lane]->image, question_.closure.shape.variables);
  }
  return values;
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
  std::vector<std::vector<double>> impact(tubes.size());
  const std::vector<Interval> values = values_of(tubes, &impact);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    if (values[i].hi < kInfinity) of[i]->upper = values[i].hi;
    of[i]->impact = std::move(impact[i]);
  }
  judge_middles(tubes, of);
}

/// A variable whose only value is no double keeps its enclosure.
SystemBoxes::Box ValueJudge::middle_of(const Box& box, const std::vector<double>& at) const {
  Box place;
  for (std::size_t k = 0; k < at.size(); ++k)
    place.push_back(question_.problem.inner[k] ? Interval(at[k]) : box[k]);
  return place;
}

/// Encloses f where the tubes have their centres.
void ValueJudge::judge_middles(std::span<const TubeTrial> tubes,
                               std::span<ValueFinding* const> findings) {
  std::vector<BranchPoint> near;
  for (const TubeTrial& trial : tubes) near.push_back({trial.tube.at, trial.tube.center});
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
  const std::vector<Interval> values = values_of(proved, nullptr);
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
  to.put(finding.attained);
  to.put_list(std::span<const double>(finding.impact));
}

ValueFinding ValueJudge::take(cluster::ByteReader& from, const ValueQuestion& question) {
  ValueFinding finding;
  finding.tube = TubeJudge::take(from, question.closure);
  finding.middle = TubeJudge::take(from, question.closure).tube;
  finding.upper = from.take<double>();
  finding.attained = from.take<double>();
  finding.impact = from.take_list<double>();
  if (std::isnan(finding.upper) || std::isnan(finding.attained) ||
      (!finding.impact.empty() && finding.impact.size() != question.closure.shape.variables))
    throw cluster::MalformedMessage();
  return finding;
}

}  // namespace regulus
