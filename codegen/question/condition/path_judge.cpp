// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/path_judge.hpp"

#include <algorithm>

namespace regulus::detail {

PathJudge::PathJudge(const PathConditionQuestion& question)
    : path_(question.path),
      rotated_(question.path.kernel(), question.scaling),
      matrices_(rotated_.matrices()) {}

void PathJudge::judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained) {
  std::vector<Box> poses;
  for (const Box& box : boxes) poses.push_back(path_.on_kernel(box));
  rotated_.evaluate(poses);
  std::vector<Box> places;
  std::vector<BoxFinding*> of;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
    BoxFinding& finding = findings[lane];
    const Box& box = boxes[lane];
    finding.is_outside = path_.is_beyond(box) || matrices_.is_outside(lane);
    if (finding.is_outside) continue;
    find_bound(rotated_, lane, finding);
    finding.bound.impact = path_.impact(box, finding.bound.impact);
    if (attained == kInfinity || PathVariety::is_group(box[0])) continue;
    if (!(finding.bound.upper > attained)) continue;
    places.push_back(path_.place(box, {}));
    of.push_back(&finding);
    if (finding.bound.growth.empty()) continue;
    places.push_back(path_.place(box, path_.slopes(box, finding.bound.growth)));
    of.push_back(&finding);
  }
  for (std::size_t first = 0; first < places.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, places.size() - first);
    show(std::span(places).subspan(first, count), std::span(of).subspan(first, count), attained);
  }
}

void PathJudge::show(std::span<const Box> places, std::span<BoxFinding* const> of,
                     double attained) {
  std::vector<Box> points;
  for (const Box& place : places) points.push_back(path_.on_kernel(place));
  const auto matrices = matrices_.at(points);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (matrices[i]) keep_attained(*of[i], places[i], *matrices[i], path_.kernel(), attained);
}

}  // namespace regulus::detail
