// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/box_judge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regulus::detail {

using cluster::ByteReader;
using cluster::ByteWriter;
using cluster::MalformedMessage;

void keep_attained(BoxFinding& finding, const std::vector<Interval>& point,
                   std::span<const Interval> A, const Problem& problem, double attained) {
  StretchedVectors shown = attained_condition(A, std::size_t(problem.kernel->rows),
                                              std::size_t(problem.kernel->columns));
  const double known = finding.attained ? finding.attained->shown.condition : attained;
  if (shown.condition > known) finding.attained.emplace(ConditionWitness{point, std::move(shown)});
}

void find_bound(RotatedBoxes& boxes, std::size_t lane, BoxFinding& finding) {
  const std::optional<RotatedBox> rotated = boxes.rotated(lane);
  finding.is_undefined = !rotated;
  if (rotated) finding.bound = bound_condition(*rotated);
  // Perhaps constraints exclude the box: all variables must become small to show it.
  if (!boxes.matrices().is_inhabited(lane)) finding.bound.impact.clear();
}

BoxJudge::BoxJudge(const ConditionQuestion& question)
    : problem_(question.problem),
      rotated_(question.problem, question.scaling),
      matrices_(rotated_.matrices()) {}

void BoxJudge::judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained) {
  rotated_.evaluate(boxes);
  std::vector<Box> points;
  std::vector<std::size_t> of;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
    BoxFinding& finding = findings[lane];
    finding.is_outside = matrices_.is_outside(lane);
    if (finding.is_outside) continue;
    find_bound(rotated_, lane, finding);
    if (attained == kInfinity) {
      finding.bound.growth.clear();
      continue;
    }
    if (matrices_.is_inhabited(lane))
      keep_attained(finding, matrices_.point(lane), matrices_.matrix_at_point(lane), problem_,
                    attained);
    if (finding.bound.growth.empty() || !(finding.bound.upper > attained)) continue;
    points.push_back(corner(boxes[lane], matrices_.point(lane), finding.bound.growth));
    of.push_back(lane);
  }
  if (points.empty()) return;
  const auto matrices = matrices_.at(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (matrices[i]) keep_attained(findings[of[i]], points[i], *matrices[i], problem_, attained);
}

void BoxJudge::put(ByteWriter& to, const BoxFinding& finding) {
  to.put(finding.is_outside);
  to.put(finding.is_undefined);
  to.put(finding.bound.upper);
  to.put_list(std::span<const double>(finding.bound.impact));
  to.put(finding.attained.has_value());
  if (!finding.attained) return;
  to.put_list(std::span<const Interval>(finding.attained->variables));
  to.put(finding.attained->shown.condition);
  to.put_list(std::span<const double>(finding.attained->shown.most));
  to.put_list(std::span<const double>(finding.attained->shown.least));
}

BoxFinding BoxJudge::take(ByteReader& from, const ConditionQuestion& question) {
  const std::size_t variables = question.problem.outer.size();
  const auto columns = std::size_t(question.problem.kernel->columns);
  BoxFinding finding;
  finding.is_outside = from.take_flag();
  finding.is_undefined = from.take_flag();
  finding.bound.upper = from.take<double>();
  finding.bound.impact = from.take_list<double>();
  const std::size_t impacts = finding.bound.impact.size();
  if (impacts != 0 && impacts != variables) throw MalformedMessage();
  if (!from.take_flag()) return finding;
  ConditionWitness& witness = finding.attained.emplace();
  witness.variables = from.take_list_of<Interval>(variables);
  witness.shown.condition = from.take<double>();
  witness.shown.most = from.take_list_of<double>(columns);
  witness.shown.least = from.take_list_of<double>(columns);
  return finding;
}

/// Returns the corner of the box in whose direction κ grows.
BoxJudge::Box BoxJudge::corner(const Box& box, Box point, const std::vector<double>& growth) const {
  for (std::size_t v = 0; v < point.size(); ++v) {
    const std::optional<Interval>& inner = problem_.inner[v];
    if (!inner || growth[v] == 0 || std::isnan(growth[v])) continue;
    point[v] = std::clamp(growth[v] > 0 ? box[v].hi : box[v].lo, inner->lo, inner->hi);
  }
  return point;
}

}  // namespace regulus::detail
