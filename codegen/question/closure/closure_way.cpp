// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/branch_threshold.hpp"
#include "codegen/question/way/path_bounds.hpp"
#include "codegen/question/way/trajectory_run.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::detail {
namespace {

/// A piece that is asked about alone has one configuration so near to its start.
constexpr double kRadiusAtJoint = 0x1p-20;

/// Returns a place a little beyond the first part of a piece that is not on the branch.
double beyond_the_branch(const ClosureResult& piece) {
  double begin = 1, end = 1;
  const std::vector<BranchLeaf>& leaves = piece.branch.tree.leaves();
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const Interval& part = leaves[leaf].at.box[0];
    if (piece.links.on_branch.at(leaf) == 0 && part.lo < begin) begin = part.lo, end = part.hi;
  }
  return std::fmin((1 + kPartBeyondBoxes) * end, 1.0);
}

class WaySearch {
 public:
  WaySearch(PreparedWay& prepared, const SearchOptions& search, const BranchSettings& settings,
            const FormingWatch& watch, const PiecesRun& run)
      : prepared_(prepared),
        search_(search),
        watch_(watch),
        run_(run),
        settings_(settings),
        deadline_(settings_),
        near_(prepared.common.near_start) {}

  WayFinding run() {
    Stopwatch watch;
    for (std::size_t k = 0; k < prepared_.pieces() && !found_.deciding; ++k) follow(k);
    conclude();
    compare();
    prepared_.common.preparation.seconds.search = watch.lap();
    return std::move(found_);
  }

 private:
  /// Searches a piece, and links it with the one before.
  void follow(std::size_t k) {
    const Problem problem = prepared_.problem_of(k);
    ClosureQuestion question{problem, prepared_.common.scaling, prepared_.common.shape, near_,
                             prepared_.common.ranges};
    if (k > 0 && !begin_piece(question, k)) return;
    found_.begins.push_back(near_);
    ClosureResult& result = found_.pieces.emplace_back();
    PieceWithoutBranch piece{k, "", {}, {}};
    if (k == 0 && !prepared_.common.obstacle_of_start.empty()) {
      result = without_start(prepared_.common, question, settings_, run_.progress);
      piece.obstacle = result.links.obstacle;
      found_.deciding = std::move(piece);
      return;
    }
    result.branch = searched(question, settings_for(piece), k);
    const MustStop must_stop = [this] { return deadline_.reason(); };
    if (settings_.paves || (result.branch.is_complete && !result.branch.is_empty))
      result.links =
          k == 0 ? link_branch(question, result.branch.tree, prepared_.common.start, must_stop)
                 : link_branch(question, result.branch.tree, before(k), must_stop);
    if (result.is_proved()) return;
    piece.obstacle = result.branch.is_empty ? "the constraints exclude every pose of the segment"
                                            : reason_of({result, {}});
    const bool is_cut = result.branch.stopped_by || must_stop();
    if (settings_.paves && !is_cut) look_beyond(piece, beyond_the_branch(result));
    found_.deciding = std::move(piece);
  }

  /// The middles of the uncertain quantities may have the branch further, or on the whole piece.
  void look_beyond(PieceWithoutBranch& piece, double lost) {
    std::vector<double> place = near_.variables;
    for (const auto& [s, is_lost] :
         {std::pair(lost, true), std::pair(1.0, true), std::pair(lost, false)}) {
      place[0] = s;
      if (!piece.is_refuted()) look_for_fold(piece, place, is_lost);
    }
  }

  [[nodiscard]] BranchResult searched(const ClosureQuestion& question,
                                      const BranchSettings& settings, std::size_t k) {
    SearchTopic topic = topic_of_branch(run_.topic, prepared_.request);
    topic.start = near_.unknowns;
    turn_to_piece(search_.workers, std::move(topic), prepared_.request.motion, k);
    return run_.kept.run(
        settings,
        [&](const BranchSettings& chosen) {
          return search_branch(question, chosen, run_.progress);
        },
        place_of_piece(k));
  }

  [[nodiscard]] BranchBefore before(std::size_t k) const {
    return {found_.pieces.at(k - 1).branch.tree};
  }

  /// Begins with the configuration at the end of the piece before.
  bool begin_piece(ClosureQuestion& question, std::size_t k) {
    const auto configuration = configuration_after(question, before(k));
    if (!configuration) {
      found_.deciding = PieceWithoutBranch{
          k, "the configuration at the begin of the segment was not found", {}, {}};
      return false;
    }
    near_.variables[0] = 0;
    for (std::size_t i = 0; i < configuration->size(); ++i)
      near_.unknowns[i] = mid((*configuration)[i]);
    question.start = near_;
    at_begin_ = *configuration;
    return true;
  }

  /// A fold is one of the mechanism itself, without copies of its unknowns.
  [[nodiscard]] bool has_copies() const {
    return prepared_.common.shape.unknowns != prepared_.request.model.closure->unknowns.size();
  }

  [[nodiscard]] BranchSettings settings_for(PieceWithoutBranch& piece) {
    BranchSettings settings = settings_;
    settings.time_limit = std::fmax(0.0, deadline_.left()) * (settings.paves ? kPartOfSearch : 1);
    for (const ClosureResult& before : found_.pieces)
      settings.max_boxes -= std::min(settings.max_boxes, before.branch.boxes);
    if (settings.paves || has_copies()) return settings;
    settings.ask = [this, &piece](const std::vector<double>& place, bool is_lost) {
      look_for_fold(piece, place, is_lost);
      return piece.is_refuted();
    };
    return settings;
  }

  /// Looks for a singular configuration between the begin of the piece and a place on it.
  void look_for_fold(PieceWithoutBranch& piece, const std::vector<double>& place, bool is_lost) {
    SearchOptions rest = search_;
    if (search_.time_limit != 0) rest.time_limit = std::fmax(deadline_.left(), 1e-9);
    PreparedClosure alone = prepare_closure(piece_alone(piece.index), 0, rest, watch_);
    if (alone.preparation.stopped || !begins_alike(alone, piece.index)) return;
    std::optional<Fold> fold = fold_beyond(alone, place, is_lost, rest, watch_);
    if (!fold) return;
    piece.fold = std::move(fold);
    piece.alone = std::move(alone);
  }

  /// The question about a piece alone, which begins near the configuration there.
  [[nodiscard]] Request piece_alone(std::size_t k) const {
    Request request = piece_request(prepared_.request, k);
    if (k == 0) return request;
    Closure& closure = *request.model.closure;
    for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
      closure.start[i] = exact_number(near_.unknowns[i]);
      closure.start_radius[i] = exact_number(kRadiusAtJoint);
    }
    return request;
  }

  /// The only configuration within the radius of its start is that of the branch.
  [[nodiscard]] bool begins_alike(const PreparedClosure& alone, std::size_t k) const {
    if (k == 0) return true;
    for (std::size_t i = 0; i < at_begin_.size(); ++i)
      if (!(mag(at_begin_[i] - alone.start.values[i]) <= alone.start.radius[i].lo)) return false;
    return true;
  }

  /// Compares a threshold, as far as the branch is followed.
  void compare() {
    if (!has_threshold(prepared_.request) || found_.pieces.empty()) return;
    if (!settings_.paves && !found_.is_proved()) return;
    const PiecesOfBranch pieces = pieces_of(prepared_, found_);
    const BoxSearchSettings rest = rest_of(settings_, deadline_, found_.result.statistics.boxes);
    found_.threshold = settings_.paves
                           ? pave_threshold(pieces, settings_.min_relative_width, rest, run_)
                           : compare_threshold(pieces, rest, run_);
    detail::conclude(found_.result, *found_.threshold);
  }

  void conclude() {
    Result& all = found_.result;
    all.method = Method::kAuto;
    all.verdict = found_.is_proved() ? Verdict::kNoSingularity : Verdict::kPossibleProblem;
    all.reason = Reason::kAllBoxesCertified;
    for (const ClosureResult& piece : found_.pieces) {
      const Result one = check_result(prepared_.common, {piece, {}});
      all.statistics.boxes += one.statistics.boxes;
      all.statistics.max_frontier =
          std::max(all.statistics.max_frontier, one.statistics.max_frontier);
      for (std::size_t rule = 0; rule < kRules; ++rule)
        all.statistics.leaves[rule] += one.statistics.leaves[rule];
      all.stopped_by = one.stopped_by;
    }
    if (!found_.deciding) {
      if (is_start_in_motion(prepared_.request.model, prepared_.request.motion))
        all.occupancy = Occupancy::kInhabited;
      return;
    }
    if (found_.is_refuted()) {
      all.verdict = Verdict::kSingularity;
      all.reason = Reason::kLostRank;
    } else if (!found_.pieces.empty()) {
      const ClosureResult& piece = found_.pieces.back();
      const Result last = check_result(prepared_.common, {piece, {}});
      if (piece.branch.is_complete && !all.stopped_by) all.stopped_by = deadline_.reason();
      // Poses remain on other pieces.
      all.reason = piece.branch.is_empty ? Reason::kWidth : last.reason;
      all.blocking_box = last.blocking_box;
    }
  }

  PreparedWay& prepared_;
  const SearchOptions& search_;
  const FormingWatch& watch_;
  const PiecesRun& run_;
  const BranchSettings settings_;
  const Deadline deadline_;
  BranchPoint near_;                ///< where the piece begins, approximately
  std::vector<Interval> at_begin_;  ///< encloses the configuration there
  WayFinding found_;
};

}  // namespace

Problem PreparedWay::problem_of(std::size_t piece) const {
  Problem problem = common.problem;
  const std::size_t first = common.shape.variables + common.shape.unknowns;
  for (std::size_t c = 0; c < values[piece].size(); ++c) {
    const Interval& value = values[piece][c];
    problem.outer.at(first + c) = value;
    problem.inner.at(first + c) = is_thin(value) ? std::optional(value) : std::nullopt;
  }
  return problem;
}

std::vector<Interval> PreparedWay::commanded(std::size_t piece, const Interval& s) const {
  std::vector<Interval> result;
  for (const PieceOfPose& part : request.motion.trajectory->pieces.at(piece).pose)
    result.push_back(CoordinateBounds(part).over(s.lo, s.hi));
  return result;
}

std::string PreparedWay::pose_at(std::size_t piece, const Interval& s) const {
  std::string text;
  const std::vector<Interval> pose = commanded(piece, s);
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const PoseParameter& p = request.model.pose[i];
    text += fmt::format("{}{} = {:.6g}{}", text.empty() ? "" : ", ", p.name, mid(pose[i]),
                        unit_suffix(p.unit));
  }
  return text;
}

PreparedWay prepare_way(Request request, double model_seconds, const SearchOptions& search,
                        const FormingWatch& watch, DerivativesBy by) {
  require_way_from_start(request.model, request.motion);
  PiecesRequest all = pieces_request(request);
  std::vector<PoseParameter> constants;
  for (const PieceConstant& constant : all.constants) constants.push_back(constant.quantity);
  PreparedWay prepared{
      std::move(request),
      prepare_closure(std::move(all.request), model_seconds, search, watch, by, constants),
      {}};
  for (std::size_t k = 0; k < prepared.request.motion.trajectory->pieces.size(); ++k) {
    std::vector<Interval>& values = prepared.values.emplace_back();
    for (const PieceConstant& constant : all.constants)
      values.push_back(enclose_constant(constant.values[k], constant.quantity.name));
  }
  fit_start(prepared.common, prepared.problem_of(0));
  prepared.request.model.closure->start_radius =
      prepared.common.request.model.closure->start_radius;
  return prepared;
}

WayFinding check_way(PreparedWay& prepared, const SearchOptions& search, const FormingWatch& watch,
                     const PiecesRun& run) {
  const BranchSettings settings = settings_of(prepared.common, search, watch.interrupt);
  return WaySearch(prepared, search, settings, watch, run).run();
}

WayFinding pave_way(PreparedWay& prepared, const SearchOptions& search, double resolution,
                    const FormingWatch& watch, const PiecesRun& run) {
  BranchSettings settings = settings_of(prepared.common, search, watch.interrupt);
  settings.paves = true;
  settings.min_relative_width = resolution;
  return WaySearch(prepared, search, settings, watch, run).run();
}

}  // namespace regulus::detail
