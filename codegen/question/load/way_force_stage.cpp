// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/way_force_stage.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/path_parts.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

/// A piece that needs more is searched alone.
constexpr std::uint32_t kMostForceBoxesOfPiece = 256;
/// The boxes of a round, in a search that is long enough for workers.
constexpr std::size_t kBoxesOfLongRound = 512;

/// The goal of the search of all pieces: runtime/search/box_search.hpp.
class WayForceGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  WayForceGoal(BoxCourse& course, PathParts& parts, const PathBounds& path, PathSteps& steps,
               std::vector<PieceForces>& pieces)
      : course_(course), parts_(parts), path_(path), steps_(steps), pieces_(pieces) {}

  void start(const TreeBox& root) {
    box_ = root.box;
    open_.push_back(parts_.whole());
  }
  [[nodiscard]] bool has_ended() const { return open_.empty(); }

  /// In rounds of an earlier run it judges only the parts that are said to be held or outside.
  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t) {
    while (boxes.empty() && !course_.must_pause()) {
      take_parts();
      if (taken_.empty()) return;
      found_.assign(taken_.size(), {});
      is_told_ = steps_.is_repeating() && steps_.take(found_);
      for (std::size_t i = 0; i < taken_.size(); ++i) {
        if (!is_judged(i)) continue;
        parts_.load_box(taken_[i], box_);
        boxes.push_back(box_);
      }
      course_.count(taken_.size() - boxes.size());
      if (boxes.empty()) settle_all();
    }
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }
  /// Returns the piece that is next.
  [[nodiscard]] std::size_t next_piece() const { return open_.empty() ? 0 : open_.back().piece; }

  void conclude(std::span<BoxOutcome> outcomes) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < taken_.size(); ++i)
      if (is_judged(i)) note(found_[i], step_of(outcomes[at++]));
    settle_all();
  }

 private:
  void take_parts() {
    taken_.clear();
    const bool is_long = course_.boxes() >= course_.settings().boxes_before_workers;
    while (!open_.empty() && taken_.size() < (is_long ? kBoxesOfLongRound : kLanes)) {
      PathPart part = std::move(open_.back());
      open_.pop_back();
      if (part.pieces == 1 && !pieces_[part.piece].is_held) continue;
      taken_.push_back(std::move(part));
    }
  }

  [[nodiscard]] bool is_judged(std::size_t i) const {
    return !is_told_ || found_[i].kind == PathStep::Kind::kCertified;
  }

  [[nodiscard]] PathStep step_of(const BoxOutcome& outcome) const {
    switch (outcome.kind) {
      case BoxOutcome::Kind::kHeld:
        return {PathStep::Kind::kCertified, Rule::kHMatrix, 0};
      case BoxOutcome::Kind::kOutside:
        return {PathStep::Kind::kCertified, Rule::kOutside, 0};
      case BoxOutcome::Kind::kNotHeld:
        return {};
      default:
        return {PathStep::Kind::kSplit, Rule::kBlocked, widest(outcome)};
    }
  }

  void note(PathStep& step, const PathStep& now) {
    if (is_told_ && (step.kind != now.kind || step.rule != now.rule)) steps_.stop_repeating();
    step = now;
  }

  void settle_all() {
    for (std::size_t i = taken_.size(); i-- > 0;) settle(taken_[i], found_[i]);
    steps_.add(found_);
  }

  void settle(PathPart& part, const PathStep& step) {
    if (step.kind == PathStep::Kind::kCertified) return leave(part, step.rule);
    if (part.pieces > 1) return parts_.split_group(part, open_);
    PieceForces& piece = pieces_[part.piece];
    const bool is_lost =
        step.kind == PathStep::Kind::kLost || ++piece.boxes > kMostForceBoxesOfPiece;
    if (is_lost || !parts_.split(part, step.variable, open_)) piece.is_held = false;
  }

  void leave(const PathPart& part, Rule rule) {
    const bool is_held = rule != Rule::kOutside;
    for (std::size_t k = part.piece; k < parts_.end_of(part); ++k)
      (is_held ? pieces_[k].is_within : pieces_[k].is_outside) = true;
    parts_.leaf(part, rule);
    course_.leave_open({part.id, parts_.depth_of(part), {}}, rule);
  }

  /// Returns the moving parameter with the greatest impact.
  [[nodiscard]] std::size_t widest(const BoxOutcome& outcome) const {
    if (outcome.impact.empty() || path_.moving().empty()) return 0;
    const auto end = outcome.impact.begin() + std::ptrdiff_t(path_.moving().size());
    return std::size_t(std::max_element(outcome.impact.begin(), end) - outcome.impact.begin());
  }

  BoxCourse& course_;
  PathParts& parts_;
  const PathBounds& path_;
  PathSteps& steps_;
  std::vector<PieceForces>& pieces_;
  std::vector<Interval> box_;
  std::vector<PathPart> open_, taken_;
  std::vector<PathStep> found_;  ///< about those that were taken
  bool is_told_ = false;         ///< by an earlier run
};

}  // namespace

WayForceStage::WayForceStage(WayForces& found, const std::string& load, const SearchOptions& search,
                             bool wants_trees, const PathWatch& watch)
    : found_(found),
      load_(load),
      search_(search),
      wants_trees_(wants_trees),
      watch_(watch),
      path_(*found.request.motion.trajectory, found.request.motion.error),
      pieces_(path_.pieces()) {}

void WayForceStage::search_all(double model_seconds) {
  FormingWatch watch;
  watch.interrupt = watch_.interrupt;
  found_.hull =
      prepare_forces(hull_request(found_.request, path_), model_seconds, load_, search_, watch);
  found_.seconds = found_.hull.preparation.seconds_spent();
  if (!must_stop(0)) search_together();
}

double WayForceStage::seconds_left() const {
  if (search_.time_limit == 0) return kInfinity;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  return std::max(0.0, search_.time_limit - spent.count());
}

bool WayForceStage::must_stop(std::size_t piece) {
  const auto& stopped = found_.hull.preparation.stopped;
  if (watch_.is_interrupted() || (stopped && stopped->interrupted))
    end(piece, Reason::kInterrupted);
  else if (stopped || seconds_left() <= 0)
    end(piece, Reason::kTimeBudget);
  else if (search_.max_boxes != 0 && found_.boxes >= search_.max_boxes)
    end(piece, Reason::kBoxBudget);
  return has_ended_;
}

void WayForceStage::end(std::size_t piece, Reason reason) {
  has_ended_ = true;
  found_.can_continue = found_.can_continue || reason != Reason::kMemory;
  if (found_.deciding) return;
  found_.reason = reason;
  found_.deciding.emplace(DecidingForces{piece, std::nullopt, {}});
}

void WayForceStage::search_together() {
  BoxSearchSettings settings;
  settings.interrupt = watch_.interrupt;
  settings.time_limit = seconds_left();
  if (search_.max_boxes != 0) settings.max_boxes = search_.max_boxes;
  settings.threads = settings_from(search_).threads;
  settings.workers = search_.workers;
  turn_to_piece(search_.workers, watch_.topic, found_.request.motion, std::nullopt);
  BoxCourse course(found_.hull.problem, settings, watch_.display);
  PathParts parts(path_, found_.hull.problem,
                  {0, uncertain_names(found_.hull.preparation.labels).size()}, wants_trees_);
  PathSteps steps(watch_.checkpoint, path_.moving().size());
  WayForceGoal goal(course, parts, path_, steps, pieces_);
  BoxSearch<BoxForces, WayForceGoal>(found_.hull.question(), kBoxesOfLongRound, course, goal).run();
  steps.save();
  course.tell_end();
  found_.boxes += course.boxes();
  found_.seconds.search += course.seconds();
  found_.trees = parts.take_trees();
  if (course.stopped_by()) end(goal.next_piece(), *course.stopped_by());
}

WayForceStage::Alone WayForceStage::search_piece(std::size_t piece, double resolution,
                                                 const ForceListener& listener, Observer* tree) {
  ++found_.searched_alone;
  FormingWatch watch;
  watch.interrupt = watch_.interrupt;
  Alone alone{prepare_forces(piece_request(found_.request, piece), 0, load_, search_, watch), {}};
  FeasibilitySettings settings = settings_of(alone.prepared, watch_.interrupt);
  settings.time_limit = std::min(settings.time_limit, seconds_left());
  settings.paves = resolution > 0;
  if (settings.paves) settings.min_relative_width = resolution;
  Observers observers(present({tree, watch_.display}));
  turn_to_piece(search_.workers, watch_.topic, found_.request.motion, piece);
  const auto run = [&](const FeasibilitySettings& chosen) {
    return run_forces(alone.prepared, chosen, listener, &observers);
  };
  settings.save_every = watch_.interval();
  JsonCheckpoint* const file = watch_.file();
  alone.result =
      file != nullptr ? file->continue_search(settings, run, place_of_piece(piece)) : run(settings);
  found_.can_continue = found_.can_continue || alone.result.stopped_by.has_value();
  found_.boxes += alone.result.boxes;
  found_.seconds += alone.prepared.preparation.seconds_spent();
  return alone;
}

}  // namespace regulus::detail
