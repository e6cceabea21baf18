// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/way_force_stage.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/way/path_parts.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus {
namespace {

/// A piece that needs more is searched alone.
constexpr std::uint32_t kMostForceBoxesOfPiece = 256;

/// The goal of the search of all pieces: runtime/search/box_search.hpp.
class WayForceGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  WayForceGoal(BoxCourse& course, PathParts& parts, const PathBounds& path,
               std::vector<PieceForces>& pieces)
      : course_(course), parts_(parts), path_(path), pieces_(pieces) {}

  void start(const TreeBox& root) {
    box_ = root.box;
    open_.push_back(parts_.whole());
  }
  [[nodiscard]] bool has_ended() const { return open_.empty(); }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t) {
    taken_.clear();
    while (!open_.empty() && boxes.size() < kLanes) {
      PathPart part = std::move(open_.back());
      open_.pop_back();
      if (part.pieces == 1 && !pieces_[part.piece].is_held) continue;
      parts_.load_box(part, box_);
      boxes.push_back(box_);
      taken_.push_back(std::move(part));
    }
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }
  /// Returns the piece that is next.
  [[nodiscard]] std::size_t next_piece() const { return open_.empty() ? 0 : open_.back().piece; }

  void conclude(std::span<BoxOutcome> outcomes) {
    for (std::size_t i = taken_.size(); i-- > 0;) settle(taken_[i], outcomes[i]);
  }

 private:
  void settle(PathPart& part, const BoxOutcome& outcome) {
    using Kind = BoxOutcome::Kind;
    if (outcome.kind == Kind::kHeld || outcome.kind == Kind::kOutside)
      return leave(part, outcome.kind == Kind::kHeld);
    if (part.pieces > 1) return parts_.split_group(part, open_);
    PieceForces& piece = pieces_[part.piece];
    const bool is_lost = outcome.kind == Kind::kNotHeld || ++piece.boxes > kMostForceBoxesOfPiece;
    if (is_lost || !parts_.split(part, widest(outcome), open_)) piece.is_held = false;
  }

  void leave(const PathPart& part, bool is_held) {
    const Rule rule = is_held ? Rule::kHMatrix : Rule::kOutside;
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
  std::vector<PieceForces>& pieces_;
  std::vector<Interval> box_;
  std::vector<PathPart> open_, taken_;
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
  if (found_.deciding) return;
  found_.reason = reason;
  found_.deciding.emplace(DecidingForces{piece, std::nullopt, {}});
}

void WayForceStage::search_together() {
  BoxSearchSettings settings;
  settings.interrupt = watch_.interrupt;
  settings.time_limit = seconds_left();
  if (search_.max_boxes != 0) settings.max_boxes = search_.max_boxes;
  BoxCourse course(found_.hull.problem, settings, watch_.display);
  PathParts parts(path_, found_.hull.problem,
                  {0, uncertain_names(found_.hull.preparation.labels).size()}, wants_trees_);
  WayForceGoal goal(course, parts, path_, pieces_);
  BoxSearch<BoxForces, WayForceGoal>(found_.hull.question(), kLanes, course, goal).run();
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
  alone.result = run_forces(alone.prepared, settings, listener, &observers);
  found_.boxes += alone.result.boxes;
  found_.seconds += alone.prepared.preparation.seconds_spent();
  return alone;
}

}  // namespace regulus
