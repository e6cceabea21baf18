// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/condition_judge.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <thread>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::inline bounding {

/// Each thread has its own.
class BoxJudges::Judge {
 public:
  explicit Judge(const ConditionQuestion& question)
      : problem_(question.problem),
        rows_(question.problem.kernel->rows),
        columns_(question.problem.kernel->columns),
        rotated_(question.problem, question.scaling),
        matrices_(rotated_.matrices()) {}

  void judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained) {
    rotated_.evaluate(boxes);
    std::vector<Box> points;
    std::vector<std::size_t> of;
    for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
      BoxFinding& finding = findings[lane];
      finding.is_outside = matrices_.is_outside(lane);
      if (finding.is_outside) continue;
      const std::optional<RotatedBox> rotated = rotated_.rotated(lane);
      finding.is_undefined = !rotated;
      if (rotated) finding.bound = bound_condition(*rotated);
      // Perhaps constraints exclude the box: all variables must become small to show it.
      if (!matrices_.is_inhabited(lane)) finding.bound.impact.clear();
      if (attained == kInfinity) continue;
      if (matrices_.is_inhabited(lane))
        keep(finding, matrices_.point(lane), matrices_.matrix_at_point(lane), attained);
      if (finding.bound.growth.empty() || !(finding.bound.upper > attained)) continue;
      points.push_back(corner(boxes[lane], matrices_.point(lane), finding.bound.growth));
      of.push_back(lane);
    }
    if (points.empty()) return;
    const auto matrices = matrices_.at(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (matrices[i]) keep(findings[of[i]], points[i], *matrices[i], attained);
  }

 private:
  /// Returns the corner of the box in whose direction κ grows.
  [[nodiscard]] Box corner(const Box& box, Box point, const std::vector<double>& growth) const {
    for (std::size_t v = 0; v < point.size(); ++v) {
      const std::optional<Interval>& inner = problem_.inner[v];
      if (!inner || growth[v] == 0 || std::isnan(growth[v])) continue;
      point[v] = std::clamp(growth[v] > 0 ? box[v].hi : box[v].lo, inner->lo, inner->hi);
    }
    return point;
  }

  void keep(BoxFinding& finding, const Box& point, std::span<const Interval> A, double attained) {
    StretchedVectors shown = attained_condition(A, rows_, columns_);
    const double known = finding.attained ? finding.attained->shown.condition : attained;
    if (shown.condition > known) finding.attained.emplace(ConditionWitness{point, shown});
  }

  const Problem& problem_;
  const std::size_t rows_, columns_;
  RotatedBoxes rotated_;
  BoxMatrices& matrices_;
};

BoxJudges::BoxJudges(const ConditionQuestion& question, unsigned threads, std::size_t most) {
  const auto needed = unsigned(std::max<std::size_t>(most / kLanes, 1));
  for (unsigned t = 0; t < std::clamp(threads, 1U, needed); ++t)
    judges_.push_back(std::make_unique<Judge>(question));
}

BoxJudges::~BoxJudges() = default;

bool BoxJudges::judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> is_out_of_memory = false;
  const auto work = [&](Judge& judge) noexcept {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    for (std::size_t at; (at = kLanes * next++) < boxes.size();) {
      const std::size_t count = std::min(kLanes, boxes.size() - at);
      try {
        judge.judge(boxes.subspan(at, count), findings.subspan(at, count), attained);
      } catch (const std::bad_alloc&) {
        is_out_of_memory = true;
      }
    }
  };
  const std::size_t batches = (boxes.size() + kLanes - 1) / kLanes;
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(judges_.size(), batches); ++t)
      others.emplace_back([&work, this, t] { work(*judges_[t]); });
    work(*judges_.front());
  }
  return !is_out_of_memory;
}

}  // namespace regulus::bounding
