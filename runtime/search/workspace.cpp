// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/workspace.hpp"

#include <deque>
#include <optional>

#include "runtime/evaluation/pose_evaluator.hpp"

namespace regulus {
namespace {

using Box = std::vector<Interval>;

class WorkspaceSearch {
 public:
  WorkspaceSearch(const Problem& problem, const Volumes& volumes, double resolution)
      : problem_(problem),
        volumes_(volumes),
        resolution_(resolution),
        lanes_(problem),
        pose_(lanes_) {}

  Workspace run(const std::atomic<bool>& interrupt) {
    open_.push_back(problem_.outer);
    while (!open_.empty() && boxes_ < kMostWorkspaceBoxes && !interrupt) look_at_some();
    for (const Box& box : open_) add(found_.undecided, box);
    return found_;
  }

 private:
  /// Decides up to eight boxes. The widest come first, so that a limit leaves narrow ones.
  void look_at_some() {
    lanes_.clear();
    pose_.forget();
    std::vector<Box> some;
    while (some.size() < kLanes && !open_.empty()) {
      lanes_.load(some.size(), open_.front());
      some.push_back(std::move(open_.front()));
      open_.pop_front();
    }
    lanes_.seal(some.size());
    boxes_ += some.size();
    const LaneMask outside = pose_.certain_outside(), inside = pose_.certain_inside();
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      if (has_lane(outside, lane))
        add(found_.outside, some[lane]);
      else if (has_lane(inside, lane))
        add(found_.inside, some[lane]);
      else
        split(std::move(some[lane]));
    }
  }

  void split(Box box) {
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

  void add(Share& share, const Box& box) const {
    ++share.boxes;
    share.volume += volumes_.volume(box);
  }

  const Problem& problem_;
  const Volumes& volumes_;
  const double resolution_;
  BoxLanes lanes_;
  PoseEvaluator pose_;
  std::deque<Box> open_;
  Workspace found_;
  std::uint64_t boxes_ = 0;
};

}  // namespace

Workspace measure_workspace(const Problem& problem, const Volumes& volumes, double resolution,
                            const std::atomic<bool>& interrupt) {
  return WorkspaceSearch(problem, volumes, resolution).run(interrupt);
}

}  // namespace regulus
