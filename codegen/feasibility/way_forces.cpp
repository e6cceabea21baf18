// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/feasibility/way_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/certificate/piece_question.hpp"
#include "codegen/model/trajectory.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/trajectory/path_run.hpp"
#include "codegen/trajectory/trajectory_request.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::inline feasibility {
namespace {

/// A piece that needs more is searched alone.
constexpr std::uint32_t kMostForceBoxesOfPiece = 256;

/// The facts about a piece.
struct PieceForces {
  bool is_held = true;     ///< nothing speaks against it
  bool is_within = false;  ///< the load is held somewhere on it
  std::uint32_t boxes = 0;
};

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
    for (std::size_t k = part.piece; is_held && k < parts_.end_of(part); ++k)
      pieces_[k].is_within = true;
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

class WayForceRun {
 public:
  WayForceRun(WayForces& found, const std::string& load, const SearchOptions& search,
              bool wants_trees, const PathWatch& watch)
      : found_(found),
        load_(load),
        search_(search),
        wants_trees_(wants_trees),
        watch_(watch),
        path_(*found.request.motion.trajectory, found.request.motion.error) {}

  void run(double model_seconds) {
    FormingWatch watch;
    watch.interrupt = watch_.interrupt;
    found_.hull =
        prepare_forces(hull_request(found_.request, path_), model_seconds, load_, search_, watch);
    found_.seconds = found_.hull.preparation.seconds_spent();
    pieces_.resize(path_.pieces());
    if (!must_stop(0)) search_together();
    if (!has_ended_)
      ask_pieces_alone(
          path_.pieces(), [this](std::size_t k) { return !pieces_[k].is_held; },
          [this](std::size_t k) { return must_stop(k) ? PieceAnswer::kStopped : search_alone(k); });
    if (found_.deciding) return;
    found_.excluded = std::size_t(std::ranges::count(pieces_, false, &PieceForces::is_within));
    if (found_.excluded == path_.pieces())
      found_.reason = Reason::kEmptyVariety;
    else
      found_.verdict = FeasibilityVerdict::kFeasible;
  }

 private:
  [[nodiscard]] double seconds_left() const {
    if (search_.time_limit == 0) return kInfinity;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    return std::max(0.0, search_.time_limit - spent.count());
  }

  bool must_stop(std::size_t piece) {
    const auto& stopped = found_.hull.preparation.stopped;
    if (watch_.is_interrupted() || (stopped && stopped->interrupted))
      end(piece, Reason::kInterrupted);
    else if (stopped || seconds_left() <= 0)
      end(piece, Reason::kTimeBudget);
    else if (search_.max_boxes != 0 && found_.boxes >= search_.max_boxes)
      end(piece, Reason::kBoxBudget);
    return has_ended_;
  }

  void end(std::size_t piece, Reason reason) {
    has_ended_ = true;
    if (found_.deciding) return;
    found_.reason = reason;
    found_.deciding.emplace(DecidingForces{piece, std::nullopt, {}});
  }

  void search_together() {
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

  PieceAnswer search_alone(std::size_t k) {
    ++found_.searched_alone;
    FormingWatch watch;
    watch.interrupt = watch_.interrupt;
    PreparedForces piece =
        prepare_forces(piece_request(found_.request, k), 0, load_, search_, watch);
    FeasibilitySettings settings = settings_of(piece, watch_.interrupt);
    settings.time_limit = std::min(settings.time_limit, seconds_left());
    TreeKept* const tree = wants_trees_ ? &found_.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    Observers observers(present({tree, watch_.display}));
    FeasibilityResult result = run_forces(
        piece, settings, [](std::span<const Interval>, ForceClaim) {}, &observers);
    found_.boxes += result.boxes;
    found_.seconds += piece.preparation.seconds_spent();
    return conclude(k, std::move(piece), std::move(result));
  }

  PieceAnswer conclude(std::size_t k, PreparedForces piece, FeasibilityResult result) {
    if (result.verdict == FeasibilityVerdict::kFeasible || result.is_empty) {
      pieces_[k].is_within = !result.is_empty;
      return PieceAnswer::kProved;
    }
    const bool is_infeasible = result.verdict == FeasibilityVerdict::kInfeasible;
    const bool is_stopped = !is_infeasible && result.stopped_by.has_value();
    if (is_infeasible || !found_.deciding) {
      found_.verdict = result.verdict;
      found_.reason = result.reason;
      found_.deciding.emplace(DecidingForces{k, std::move(piece), std::move(result)});
    }
    return is_infeasible ? PieceAnswer::kRefuted
           : is_stopped  ? PieceAnswer::kStopped
                         : PieceAnswer::kOpen;
  }

  WayForces& found_;
  const std::string& load_;
  const SearchOptions& search_;
  const bool wants_trees_;
  const PathWatch watch_;
  const PathBounds path_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<PieceForces> pieces_;
  bool has_ended_ = false;
};

}  // namespace

WayForces check_forces_along_way(Request request, double model_seconds, const std::string& load,
                                 SearchOptions search, bool wants_trees, const PathWatch& watch) {
  settle_options(search);
  WayForces found;
  found.request = std::move(request);
  found.request.motion.alpha = 0;
  WayForceRun(found, load, search, wants_trees, watch).run(model_seconds);
  return found;
}

}  // namespace regulus::feasibility
