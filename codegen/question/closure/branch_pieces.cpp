// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/uncertain_values.hpp"
#include "codegen/question/way/path_bounds.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus {
namespace {

PreparedWay prepare_pieces(const Request& request, double model_seconds,
                           const SearchOptions& search, const FormingWatch& watch,
                           DerivativesBy by) {
  if (request.motion.trajectory) return prepare_way(request, model_seconds, search, watch, by);
  return {request, prepare_closure(request, model_seconds, search, watch, by),
          std::vector<std::vector<Interval>>(1)};
}

/// Returns the finding about a branch over ranges as that of one piece.
WayFinding as_one_piece(const PreparedClosure& prepared, ClosureFinding found) {
  WayFinding one;
  if (!found.searched.is_proved()) {
    const bool is_empty = found.searched.branch.is_empty;
    one.deciding = PieceWithoutBranch{0, is_empty ? "" : reason_of(found), {}, {}};
    if (const Fold* const fold = found.reached()) one.deciding->fold = *fold;
  }
  one.begins.push_back(prepared.near_start);
  one.pieces.push_back(std::move(found.searched));
  return one;
}

void add(BracketOfPieces& all, ValueBracket found, std::size_t piece) {
  all.upper = piece == 0 ? found.upper : std::fmax(all.upper, found.upper);
  if (found.place) {
    all.attained = found.attained;
    all.piece = piece;
    all.place = std::move(found.place);
    all.at = std::move(found.at);
  }
  if (!all.stopped_by) all.stopped_by = found.stopped_by;
  all.boxes += found.boxes;
  all.seconds += found.seconds;
  all.trees.push_back(std::move(found.tree));
}

}  // namespace

BranchInPieces::BranchInPieces(const Request& request, double model_seconds,
                               const SearchOptions& search, const FormingWatch& watch,
                               DerivativesBy by)
    : prepared_(prepare_pieces(request, model_seconds, search, watch, by)) {}

void BranchInPieces::take(ClosureFinding found) {
  folds_ = found.folds;
  found_ = as_one_piece(common(), std::move(found));
}

void BranchInPieces::turn_to_piece(cluster::Workers* workers, SearchTopic topic,
                                   std::size_t piece) const {
  const Motion& motion = prepared_.request.motion;
  if (trajectory() == nullptr) return turn_to(workers, std::move(topic), motion);
  topic.start = found_.begins.at(piece).unknowns;
  regulus::turn_to_piece(workers, std::move(topic), motion, piece);
}

std::string BranchInPieces::part_of_name(std::size_t piece) const {
  return trajectory() == nullptr ? "" : ", " + place_of_piece(piece);
}

KeepPiece BranchInPieces::keep_pieces(const KeptPieces& kept) const {
  if (kept.file == nullptr) return {};
  return [this, &kept](std::size_t piece, const BranchSettings& settings,
                       const SearchOfBranch& search) {
    return kept.run(settings, search, part_of_name(piece));
  };
}

void BranchInPieces::follow(const SearchOptions& search, const FormingWatch& watch,
                            const PiecesRun& run) {
  const KeepPiece keep = keep_pieces(run.kept);
  if (trajectory() != nullptr) {
    found_ = check_way(prepared_, search, watch, run.progress, keep, run.topic);
    return;
  }
  turn_to(search.workers, run.topic, prepared_.request.motion);
  const KeepBranch keep_one = keep ? std::bind_front(keep, std::size_t{0}) : KeepBranch();
  const bool has_copies =
      common().shape.unknowns != common().request.model.closure->unknowns.size();
  if (has_copies)
    take({run_closure(common(), settings_of(common(), search, watch.interrupt), run.progress,
                      keep_one),
          {}});
  else
    take(check_closure(common(), search, watch, run.progress, keep_one));
}

void BranchInPieces::pave(const SearchOptions& search, double resolution, const FormingWatch& watch,
                          const PiecesRun& run) {
  const KeepPiece keep = keep_pieces(run.kept);
  if (trajectory() != nullptr) {
    found_ = pave_way(prepared_, search, resolution, watch, run.progress, keep, run.topic);
    return;
  }
  turn_to(search.workers, run.topic, prepared_.request.motion);
  take(pave_closure(common(), search, resolution, watch, run.progress,
                    keep ? std::bind_front(keep, std::size_t{0}) : KeepBranch()));
}

std::vector<Interval> BranchInPieces::commanded(std::size_t piece, const Interval& s) const {
  std::vector<Interval> values;
  for (const PieceOfPose& part : trajectory()->pieces.at(piece).pose)
    values.push_back(CoordinateBounds(part).over(s.lo, s.hi));
  return values;
}

std::string BranchInPieces::pose_at(std::size_t piece, const Interval& s) const {
  std::string text;
  const std::vector<Interval> values = commanded(piece, s);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const PoseParameter& p = prepared_.request.model.pose[i];
    text += fmt::format("{}{} = {:.6g}{}", text.empty() ? "" : ", ", p.name, mid(values[i]),
                        unit_suffix(p.unit));
  }
  return text;
}

bool BranchInPieces::is_empty() const {
  return trajectory() == nullptr && found_.pieces.front().branch.is_empty;
}

const PieceWithoutBranch* BranchInPieces::end() const {
  return found_.deciding && found_.deciding->is_refuted() ? &*found_.deciding : nullptr;
}

const PreparedClosure& BranchInPieces::question_of_end() const {
  return found_.deciding && found_.deciding->alone ? *found_.deciding->alone : common();
}

std::string BranchInPieces::obstacle() const {
  if (!found_.deciding || found_.deciding->obstacle.empty()) return "";
  const PieceWithoutBranch& piece = *found_.deciding;
  if (trajectory() == nullptr) return piece.obstacle;
  return piece.obstacle + ", on " + describe_segment(*trajectory(), piece.index, std::nullopt);
}

std::uint64_t BranchInPieces::boxes() const {
  std::uint64_t sum = 0;
  for (const ClosureResult& piece : found_.pieces) sum += piece.branch.boxes;
  return sum;
}

std::optional<Reason> BranchInPieces::stopped_by() const {
  if (found_.pieces.empty()) return std::nullopt;
  const ClosureResult& last = found_.pieces.back();
  return last.branch.stopped_by ? last.branch.stopped_by : last.links.stopped_by;
}

ProvedPieces BranchInPieces::proved() const {
  ProvedPieces proved{prepared_.request, common().preparation.labels, {}};
  for (const ClosureResult& piece : found_.pieces) proved.trees.push_back(&piece.branch.tree);
  return proved;
}

ProvedPieces BranchInPieces::proved(const std::vector<BranchTree>& trees) const {
  ProvedPieces proved{prepared_.request, common().preparation.labels, {}};
  for (const BranchTree& tree : trees) proved.trees.push_back(&tree);
  return proved;
}

ProofStatus BranchInPieces::certify_end(const std::string& path,
                                        const ProofPlacing& placing) const {
  return trajectory() != nullptr ? certify_way(path, prepared_, found_, placing)
                                 : certify_fold(path, common(), *end()->fold, placing);
}

/// A value that one piece attains ends the searches of later pieces earlier. So the file names it beside
/// the piece: a search goes on only from one that knew the same value.
BracketOfPieces BranchInPieces::bracket(const BranchValue& value, ValueAim aim,
                                        const BoxSearchSettings& settings,
                                        const PiecesRun& run) const {
  BracketOfPieces all;
  for (std::size_t k = 0; k < pieces(); ++k) {
    QuestionOfPiece piece(*this, k);
    aim.attained = all.attained;
    turn_to_piece(settings.workers, run.topic, k);
    const auto search = [&](const BoxSearchSettings& chosen) {
      return search_value({piece.problem, piece.closure, value}, found_.pieces[k].branch.tree, aim,
                          chosen, piece.is_possible, run.progress);
    };
    const std::string after = k == 0 ? "" : fmt::format(" after {:a}", aim.attained);
    add(all,
        run.kept.run(share_of(settings, all.boxes, all.seconds, pieces() - k), search,
                     part_of_name(k) + after),
        k);
    if (aim.from && all.attained >= *aim.from) break;
  }
  if (all.trees.size() < pieces()) all.upper = kInfinity;
  all.is_closed = aim.is_met(all.attained, all.upper);
  if (all.is_closed) all.stopped_by.reset();
  return all;
}

QuestionOfPiece::QuestionOfPiece(const BranchInPieces& branch, std::size_t piece)
    : problem(branch.way().problem_of(piece)),
      closure{problem, branch.common().scaling, branch.common().shape,
              branch.found().begins.at(piece), branch.common().ranges},
      system(problem, branch.common().scaling, branch.common().shape),
      is_possible([this, &branch](const std::vector<Interval>& point) {
        return is_in_motion(branch.common(), system, point);
      }) {}

BoxSearchSettings share_of(const BoxSearchSettings& all, std::uint64_t spent_boxes,
                           double spent_seconds, std::size_t pieces) {
  if (pieces == 1 && spent_boxes == 0) return all;
  BoxSearchSettings share = all;
  share.time_limit = std::fmax(0.0, all.time_limit - spent_seconds) / double(pieces);
  share.max_boxes = (all.max_boxes - std::min(all.max_boxes, spent_boxes)) / pieces;
  return share;
}

}  // namespace regulus
