// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/root_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regulus {
namespace {

constexpr std::size_t kBoxesOfRound = 64;

/// The goal of the search: box_search.hpp. The last box that was made is judged first.
class RootGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  RootGoal(BoxCourse& course, const RootQuestion& question, const RootSettings& settings)
      : course_(course), settings_(settings), shape_(question.shape) {
    for (std::size_t k = 0; k < shape_.variables + shape_.unknowns; ++k)
      ranges_.push_back(k < shape_.variables ? kInfinity : width_ru(question.problem.outer[k]));
  }

  void start(TreeBox root) { open_.push_back(std::move(root)); }
  [[nodiscard]] bool has_ended() const {
    return open_.empty() || (!list_.open.empty() && course_.boxes() >= last_box_);
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    const std::size_t count = std::min<std::uint64_t>(std::min(kBoxesOfRound, open_.size()), left);
    take_last(open_, count, round_, boxes);
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<RootFinding> findings) {
    for (std::size_t i = round_.size(); i-- > 0;) conclude(round_[i], findings[i]);
  }

  RootList finish() {
    for (const TreeBox& box : open_) {
      course_.leave_open(box, Rule::kBlocked);
      list_.open.push_back(unknowns_of(box));
    }
    list_.boxes = course_.boxes();
    list_.seconds = course_.seconds();
    list_.stopped_by = course_.stopped_by();
    if (course_.lacks_memory()) list_.stopped_by = Reason::kMemory;
    list_.is_complete = list_.open.empty() && !list_.stopped_by;
    course_.tell_end();
    return std::move(list_);
  }

 private:
  void conclude(TreeBox& box, RootFinding& finding) {
    if (finding.is_empty) return course_.leaf(box, Rule::kOutside);
    if (finding.root) {
      list_.roots.push_back(std::move(*finding.root));
      return course_.leaf(box, Rule::kSecondOrder);
    }
    std::ranges::copy(finding.unknowns, box.box.begin() + std::ptrdiff_t(shape_.variables));
    if (finding.is_regular) {
      list_.regular.push_back(unknowns_of(box));
      return course_.leaf(box, Rule::kSecondOrder);
    }
    const auto variable =
        choose_variable(box.box, ranges_, finding.impact, settings_.min_relative_width);
    if (!variable) return block(box, finding);
    auto [lower, upper] = course_.split(std::move(box), *variable);
    open_.push_back(std::move(upper));
    open_.push_back(std::move(lower));
  }

  void block(const TreeBox& box, const RootFinding& finding) {
    if (list_.open.empty()) last_box_ = course_.boxes() + settings_.boxes_after_problem;
    list_.is_undefined = list_.is_undefined || finding.is_undefined;
    list_.open.push_back(unknowns_of(box));
    course_.leaf(box, Rule::kBlocked);
  }

  [[nodiscard]] std::vector<Interval> unknowns_of(const TreeBox& box) const {
    return {box.box.begin() + std::ptrdiff_t(shape_.variables), box.box.end()};
  }

  BoxCourse& course_;
  const RootSettings& settings_;
  const ClosedShape shape_;
  std::vector<double> ranges_;
  std::vector<TreeBox> open_, round_;
  std::uint64_t last_box_ = 0;
  RootList list_;
};

/// Returns the values of `root`, moved by whole periods to be near those of `other`.
std::vector<Interval> moved_to(const Root& root, const Root& other,
                               const std::vector<Interval>& periods) {
  std::vector<Interval> values = root.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (periods[i] == Interval(0.0)) continue;
    const double turns = std::round((mid(other.values[i]) - mid(values[i])) / mid(periods[i]));
    values[i] += Interval(turns) * periods[i];
  }
  return values;
}

enum class Same { kYes, kNo, kUnknown };

Same are_same(const Root& a, const Root& b, const std::vector<Interval>& periods) {
  const std::vector<Interval> near = moved_to(b, a, periods);
  if (a.is(near) || b.is(moved_to(a, b, periods))) return Same::kYes;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!certain_disjoint(near[i], a.values[i])) continue;
    if (periods[i] == Interval(0.0)) return Same::kNo;
    // Two turns and more lead far away.
    if (mag(near[i] - a.values[i]) < mig(periods[i]) &&
        certain_disjoint(near[i] + periods[i], a.values[i]) &&
        certain_disjoint(near[i] - periods[i], a.values[i]))
      return Same::kNo;
  }
  return Same::kUnknown;
}

/// Keeps one of those that are the same.
void keep_different(RootList& list, const std::vector<Interval>& periods) {
  std::vector<Root> kept;
  for (Root& root : list.roots) {
    Same same = Same::kNo;
    for (const Root& other : kept)
      if (same = are_same(other, root, periods); same != Same::kNo) break;
    if (same == Same::kUnknown) {
      list.is_doubtful = true;
      list.open.push_back(root.values);
    }
    if (same == Same::kNo) kept.push_back(std::move(root));
  }
  list.roots = std::move(kept);
  list.is_complete = list.is_complete && !list.is_doubtful;
}

}  // namespace

RootList search_roots(const RootQuestion& question, const std::vector<Interval>& periods,
                      const RootSettings& settings, Observer* progress) {
  BoxCourse course(question.problem, settings, progress);
  RootGoal goal(course, question, settings);
  BoxSearch<RootJudge, RootGoal>(question, kBoxesOfRound, course, goal).run();
  RootList list = goal.finish();
  keep_different(list, periods);
  return list;
}

}  // namespace regulus
