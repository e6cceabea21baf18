// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/feasibility_search.hpp"

#include <algorithm>
#include <utility>

namespace regulus::detail {
namespace {

/// The boxes of a round.
constexpr std::size_t kBoxesOfRound = 256;
constexpr std::uint64_t kBoxesAfterProblem = 4096;
/// Halves are rounded, so a small slack avoids one halving too many.
constexpr double kSlackOfWidth = 1 + 0x1p-30;

/// The goal of the search: box_search.hpp. The last box that was made is judged first.
class ForceGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  ForceGoal(BoxCourse& course, const Problem& problem, const FeasibilitySettings& settings,
            const ForceListener& listener)
      : course_(course), settings_(settings), listener_(listener) {
    for (std::size_t k = 0; k < problem.kernel->motion_variables; ++k)
      ranges_.push_back(width_ru(problem.outer[k]));
  }

  void start(TreeBox root) { open_.push_back(std::move(root)); }

  [[nodiscard]] bool has_ended() const {
    return open_.empty() || (result_.witness && !settings_.paves);
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    if (has_looked_enough()) return;
    course_.take_round(open_, kBoxesOfRound, left, round_, boxes,
                       [this](SavedTree& tree) { describe(tree); });
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<BoxOutcome> outcomes) {
    for (std::size_t i = 0; i < round_.size(); ++i) note(round_[i].id, outcomes[i]);
    for (std::size_t i = round_.size(); i-- > 0;) {
      if (settle(round_[i], outcomes[i])) continue;
      const std::size_t variable = *choose(round_[i], outcomes[i]);
      auto [lower, upper] = course_.split(std::move(round_[i]), variable);
      open_.push_back(std::move(upper));
      open_.push_back(std::move(lower));
    }
  }

  [[nodiscard]] std::size_t splittable() const { return ranges_.size(); }
  void describe(SavedTree& tree) const {
    for (const TreeBox& box : open_) tree.add_open(box.id, kInfinity);
    tree.shown = shown_;
    tree.own = {boxes_when_blocked_};
  }

  void recall(const TreeBox& box, BoxOutcome& outcome) { note(box.id, outcome); }

  void resume(TreeBox box, BoxOutcome& outcome, bool) {
    note(box.id, outcome);
    if (!settle(box, outcome)) open_.push_back(std::move(box));
    boxes_when_blocked_ = saved_boxes_when_blocked_;
  }

  void reopen(TreeBox box) { open_.push_back(std::move(box)); }

  void resume_own(std::span<const std::uint64_t> own) {
    if (own.size() != 1) throw SavedTreeError("the numbers of the search are missing");
    saved_boxes_when_blocked_ = std::min(own[0], course_.boxes());
  }

  FeasibilityResult finish() {
    for (const TreeBox& open : open_)
      if (!result_.witness || settings_.paves) tell(open, ForceClaim::kUndecided);
    result_.boxes = course_.boxes();
    result_.seconds = course_.seconds();
    result_.stopped_by = course_.stopped_by();
    result_.is_continued = course_.is_continued();
    result_.is_empty = open_.empty() && all_outside_;
    if (result_.witness)
      result_.verdict = FeasibilityVerdict::kInfeasible;
    else if (open_.empty() && !is_blocked_ && !all_outside_ && !has_infeasible_)
      result_.verdict = FeasibilityVerdict::kFeasible;
    if (result_.verdict == FeasibilityVerdict::kPossibleProblem && !is_blocked_)
      result_.reason =
          result_.stopped_by.value_or(result_.is_empty ? Reason::kEmptyVariety : Reason::kWidth);
    course_.tell_end();
    return std::move(result_);
  }

 private:
  using Kind = BoxOutcome::Kind;

  /// After a problem only a witness is looked for.
  [[nodiscard]] bool has_looked_enough() const {
    return is_blocked_ && !settings_.paves &&
           course_.boxes() >= boxes_when_blocked_ + kBoxesAfterProblem;
  }

  void note(BoxId box, BoxOutcome& outcome) {
    const bool shows_pose = outcome.is_inhabited && !result_.is_inhabited;
    const bool shows_witness = outcome.witness && !result_.witness;
    if (shows_pose || shows_witness) shown_.push_back(box);
    result_.is_inhabited = result_.is_inhabited || outcome.is_inhabited;
    if (shows_witness) result_.witness = std::move(outcome.witness);
  }

  /// Returns false if the box must be split. A paving goes on below a pose that defeats the test,
  /// because others of the box may not.
  [[nodiscard]] bool settle(const TreeBox& box, const BoxOutcome& outcome) {
    if (outcome.kind == Kind::kOutside) return leave(box, ForceClaim::kOutside);
    if (outcome.kind == Kind::kHeld) {
      all_outside_ = false;
      return leave(box, ForceClaim::kFeasible);
    }
    if (outcome.kind == Kind::kNotHeld) {
      all_outside_ = false;
      has_infeasible_ = has_infeasible_ || settings_.paves || outcome.is_inhabited;
      if (settings_.paves || outcome.is_inhabited) return leave(box, ForceClaim::kInfeasible);
    }
    const bool is_given_up = outcome.is_hopeless && !settings_.paves;
    return (is_given_up || !choose(box, outcome)) && block(box, reason_of(outcome));
  }

  bool leave(const TreeBox& box, ForceClaim claim) {
    listener_(box.box, claim);
    course_.leaf(box, rule_of(claim));
    return true;
  }

  /// The same for a box that is left at the end.
  void tell(const TreeBox& box, ForceClaim claim) {
    listener_(box.box, claim);
    course_.leave_open(box, rule_of(claim));
  }

  static Rule rule_of(ForceClaim claim) {
    return claim == ForceClaim::kFeasible     ? Rule::kHMatrix
           : claim == ForceClaim::kInfeasible ? Rule::kWitness
           : claim == ForceClaim::kOutside    ? Rule::kOutside
                                              : Rule::kBlocked;
  }

  bool block(const TreeBox& box, Reason reason) {
    all_outside_ = false;
    if (!is_blocked_) {
      result_.blocking_box = box.box;
      result_.reason = reason;
      boxes_when_blocked_ = course_.boxes();
    }
    is_blocked_ = true;
    return leave(box, ForceClaim::kUndecided);
  }

  [[nodiscard]] static Reason reason_of(const BoxOutcome& outcome) {
    if (outcome.is_undefined) return Reason::kUndefined;
    return outcome.is_hopeless ? Reason::kUncertainty : Reason::kWidth;
  }

  [[nodiscard]] std::optional<std::size_t> choose(const TreeBox& box,
                                                  const BoxOutcome& outcome) const {
    return choose_variable(box.box, ranges_, outcome.impact,
                           settings_.min_relative_width * kSlackOfWidth);
  }

  BoxCourse& course_;
  const FeasibilitySettings& settings_;
  const ForceListener& listener_;
  std::vector<double> ranges_;
  std::vector<TreeBox> open_, round_;
  std::vector<BoxId> shown_;
  bool all_outside_ = true, is_blocked_ = false, has_infeasible_ = false;
  std::uint64_t boxes_when_blocked_ = 0, saved_boxes_when_blocked_ = 0;
  FeasibilityResult result_;
};

}  // namespace

FeasibilityResult search_forces(const ForceQuestion& question, const FeasibilitySettings& settings,
                                const ForceListener& listener, Observer* progress) {
  BoxCourse course(question.problem, settings, progress);
  ForceGoal goal(course, question.problem, settings, listener);
  BoxSearch<BoxForces, ForceGoal>(question, kBoxesOfRound, course, goal).run();
  return goal.finish();
}

}  // namespace regulus::detail
