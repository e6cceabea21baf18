// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/workspace.hpp"

#include <deque>
#include <optional>

#include "runtime/evaluation/pose_evaluator.hpp"
#include "runtime/search/box_search.hpp"

namespace regulus::detail {
namespace {

struct PoseQuestion {
  const Problem& problem;
};

struct PoseFinding {
  bool is_outside = false, is_inside = false;
};

/// A judge of boxes (box_judges.hpp): do their poses meet the constraints?
class PoseJudge {
 public:
  using Question = PoseQuestion;
  using Finding = PoseFinding;

  explicit PoseJudge(const PoseQuestion& question) : lanes_(question.problem), pose_(lanes_) {}
  PoseJudge(const PoseJudge&) = delete;
  PoseJudge& operator=(const PoseJudge&) = delete;

  void judge(std::span<const std::vector<Interval>> boxes, std::span<PoseFinding> findings,
             double) {
    lanes_.clear();
    pose_.forget();
    for (std::size_t lane = 0; lane < boxes.size(); ++lane) lanes_.load(lane, boxes[lane]);
    lanes_.seal(boxes.size());
    const LaneMask outside = pose_.certain_outside(), inside = pose_.certain_inside();
    for (std::size_t lane = 0; lane < boxes.size(); ++lane)
      findings[lane] = {has_lane(outside, lane), has_lane(inside, lane)};
  }
  static void put(cluster::ByteWriter& to, const PoseFinding& finding) { to.put(finding); }
  static PoseFinding take(cluster::ByteReader& from, const PoseQuestion&) {
    const bool is_outside = from.take_flag();
    return {is_outside, from.take_flag()};
  }

 private:
  BoxLanes lanes_;
  PoseEvaluator pose_;
};

/// The goal of the search: the widest boxes come first, so that a limit leaves narrow ones.
class WorkspaceGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  WorkspaceGoal(const Problem& problem, const Volumes& volumes, double resolution)
      : problem_(problem), volumes_(volumes), resolution_(resolution) {}

  void start(TreeBox root) { open_.push_back(std::move(root.box)); }
  [[nodiscard]] bool has_ended() const { return open_.empty(); }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t) {
    while (boxes.size() < kLanes && !open_.empty()) {
      boxes.push_back(std::move(open_.front()));
      open_.pop_front();
    }
    round_ = boxes;
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<const PoseFinding> findings) {
    for (std::size_t i = 0; i < round_.size(); ++i) {
      if (findings[i].is_outside)
        add(found_.outside, round_[i]);
      else if (findings[i].is_inside)
        add(found_.inside, round_[i]);
      else
        split(std::move(round_[i]));
    }
  }

  Workspace finish() {
    for (const std::vector<Interval>& box : open_) add(found_.undecided, box);
    return found_;
  }

 private:
  void split(std::vector<Interval> box) {
    std::size_t widest = 0;
    double most = resolution_;
    for (const std::size_t k : volumes_.axes()) {
      const double part = approx_width(box[k]) / approx_width(problem_.outer[k]);
      if (part > most) widest = k, most = part;
    }
    const auto halves = most > resolution_ ? bisect(box[widest]) : std::nullopt;
    if (!halves) return add(found_.undecided, box);
    box[widest] = halves->left;
    open_.push_back(box);
    box[widest] = halves->right;
    open_.push_back(std::move(box));
  }

  static double approx_width(Interval x) { return x.hi - x.lo; }

  void add(Share& share, const std::vector<Interval>& box) const {
    ++share.boxes;
    share.volume += volumes_.volume(box);
  }

  const Problem& problem_;
  const Volumes& volumes_;
  const double resolution_;
  std::deque<std::vector<Interval>> open_;
  std::vector<std::vector<Interval>> round_;
  Workspace found_;
};

}  // namespace

Workspace measure_workspace(const Problem& problem, const Volumes& volumes, double resolution,
                            const std::atomic<bool>& interrupt) {
  BoxSearchSettings settings;
  settings.max_boxes = kMostWorkspaceBoxes;
  settings.interrupt = &interrupt;
  BoxCourse course(problem, settings, nullptr);
  WorkspaceGoal goal(problem, volumes, resolution);
  BoxSearch<PoseJudge, WorkspaceGoal>({problem}, kLanes, course, goal).run();
  return goal.finish();
}

}  // namespace regulus::detail
