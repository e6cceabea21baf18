// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/way_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {
namespace {

/// A piece that needs more is searched alone.
constexpr std::uint32_t kMostForceBoxesOfPiece = 256;
constexpr std::size_t kMostUndecidedPieces = 8;

class WayForceRun {
 public:
  WayForceRun(WayForces& found, const std::string& load, const SearchOptions& search,
              bool wants_trees, const std::atomic<bool>* interrupt)
      : found_(found),
        load_(load),
        search_(search),
        wants_trees_(wants_trees),
        interrupt_(interrupt),
        path_(*found.request.motion.trajectory, found.request.motion.error) {}

  void run(double model_seconds) {
    FormingWatch watch;
    watch.interrupt = interrupt_;
    found_.hull =
        prepare_forces(hull_request(found_.request, path_), model_seconds, load_, search_, watch);
    found_.seconds = found_.hull.preparation.seconds_spent();
    held_.assign(path_.pieces(), true);
    is_within_.assign(path_.pieces(), false);
    boxes_.assign(path_.pieces(), 0);
    if (!must_stop(0)) search_together();
    for (std::size_t k = 0; k < path_.pieces() && !has_ended_; ++k)
      if (!held_[k] && !must_stop(k)) search_alone(k);
    if (found_.deciding) return;
    found_.excluded = std::size_t(std::ranges::count(is_within_, false));
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
    if ((interrupt_ != nullptr && *interrupt_) || (stopped && stopped->interrupted))
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
    const Problem& problem = found_.hull.problem;
    PathParts parts(path_, problem, {0, uncertain_names(found_.hull.preparation.labels).size()},
                    wants_trees_);
    BoxForces forces(found_.hull.question());
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<PathPart> open{parts.whole()};
    while (!open.empty() && !must_stop(open.back().piece)) decide_some(parts, forces, open);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    found_.seconds.search += spent.count();
    found_.trees = parts.take_trees();
  }

  void decide_some(PathParts& parts, BoxForces& forces, std::vector<PathPart>& open) {
    std::vector<PathPart> taken;
    std::vector<std::vector<Interval>> boxes;
    while (!open.empty() && boxes.size() < kLanes) {
      PathPart part = std::move(open.back());
      open.pop_back();
      if (part.pieces == 1 && !held_[part.piece]) continue;
      boxes.push_back(found_.hull.problem.outer);
      parts.load_box(part, boxes.back());
      taken.push_back(std::move(part));
    }
    if (boxes.empty()) return;
    found_.boxes += boxes.size();
    const std::vector<BoxOutcome> outcomes = forces.decide(boxes);
    for (std::size_t i = taken.size(); i-- > 0;) settle(parts, taken[i], outcomes[i], open);
  }

  void settle(PathParts& parts, PathPart& part, const BoxOutcome& outcome,
              std::vector<PathPart>& open) {
    using Kind = BoxOutcome::Kind;
    if (outcome.kind == Kind::kHeld || outcome.kind == Kind::kOutside) {
      const bool held = outcome.kind == Kind::kHeld;
      for (std::size_t k = part.piece; held && k < parts.end_of(part); ++k) is_within_[k] = true;
      return parts.leaf(part, held ? Rule::kHMatrix : Rule::kOutside);
    }
    if (part.pieces > 1) return parts.split_group(part, open);
    const bool is_lost =
        outcome.kind == Kind::kNotHeld || ++boxes_[part.piece] > kMostForceBoxesOfPiece;
    if (is_lost || !parts.split(part, widest(outcome), open)) held_[part.piece] = false;
  }

  /// Returns the moving parameter with the greatest impact.
  [[nodiscard]] std::size_t widest(const BoxOutcome& outcome) const {
    if (outcome.impact.empty() || path_.moving().empty()) return 0;
    const auto end = outcome.impact.begin() + std::ptrdiff_t(path_.moving().size());
    return std::size_t(std::max_element(outcome.impact.begin(), end) - outcome.impact.begin());
  }

  void search_alone(std::size_t k) {
    ++found_.searched_alone;
    FormingWatch watch;
    watch.interrupt = interrupt_;
    PreparedForces piece =
        prepare_forces(piece_request(found_.request, k), 0, load_, search_, watch);
    FeasibilitySettings settings = settings_of(piece, interrupt_);
    settings.time_limit = std::min(settings.time_limit, seconds_left());
    TreeKept* const tree = wants_trees_ ? &found_.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    FeasibilityResult result = run_forces(
        piece, settings, [](std::span<const Interval>, ForceClaim) {}, tree);
    found_.boxes += result.boxes;
    found_.seconds += piece.preparation.seconds_spent();
    conclude(k, std::move(piece), std::move(result));
  }

  void conclude(std::size_t k, PreparedForces piece, FeasibilityResult result) {
    if (result.verdict == FeasibilityVerdict::kFeasible || result.is_empty) {
      is_within_[k] = !result.is_empty;
      return;
    }
    const bool is_infeasible = result.verdict == FeasibilityVerdict::kInfeasible;
    const bool is_stopped = !is_infeasible && result.stopped_by.has_value();
    if (is_infeasible || !found_.deciding) {
      found_.verdict = result.verdict;
      found_.reason = result.reason;
      found_.deciding.emplace(DecidingForces{k, std::move(piece), std::move(result)});
    }
    has_ended_ = is_infeasible || is_stopped || ++undecided_ == kMostUndecidedPieces;
  }

  WayForces& found_;
  const std::string& load_;
  const SearchOptions& search_;
  const bool wants_trees_;
  const std::atomic<bool>* const interrupt_;
  const PathBounds path_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<bool> held_;       ///< by piece: nothing speaks against it
  std::vector<bool> is_within_;  ///< by piece: the load is held somewhere on it
  std::vector<std::uint32_t> boxes_;
  std::size_t undecided_ = 0;
  bool has_ended_ = false;
};

}  // namespace

WayForces check_forces_along_way(Request request, double model_seconds, const std::string& load,
                                 SearchOptions search, bool wants_trees,
                                 const std::atomic<bool>* interrupt) {
  settle_options(search);
  WayForces found;
  found.request = std::move(request);
  found.request.motion.alpha = 0;
  WayForceRun(found, load, search, wants_trees, interrupt).run(model_seconds);
  return found;
}

}  // namespace regulus
