// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_pieces.hpp"

#include <fmt/format.h>

#include <utility>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

PreparedWay prepare_pieces(Request request, double model_seconds, const SearchOptions& search,
                           const FormingWatch& watch, DerivativesBy by) {
  request.motion.alpha = 0;
  if (request.motion.trajectory) return prepare_way(request, model_seconds, search, watch, by);
  (void)start_within_constraints(request.model, request.motion);
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

}  // namespace

BranchInPieces::BranchInPieces(const Request& request, double model_seconds,
                               const SearchOptions& search, const FormingWatch& watch,
                               DerivativesBy by)
    : prepared_(prepare_pieces(request, model_seconds, search, watch, by)) {}

void BranchInPieces::take(ClosureFinding found) {
  folds_ = found.folds;
  found_ = as_one_piece(common(), std::move(found));
}

void BranchInPieces::follow(const SearchOptions& search, const FormingWatch& watch,
                            const PiecesRun& run) {
  if (trajectory() != nullptr) {
    found_ = check_way(prepared_, search, watch, run);
    return;
  }
  const bool has_copies =
      common().shape.unknowns != common().request.model.closure->unknowns.size();
  if (!has_copies) return take(check_closure(common(), search, watch, run));
  turn_to(search.workers, run.topic, prepared_.request.motion);
  take({run_closure(common(), settings_of(common(), search, watch.interrupt), run.progress,
                    run.kept)});
}

void BranchInPieces::pave(const SearchOptions& search, double resolution, const FormingWatch& watch,
                          const PiecesRun& run) {
  if (trajectory() != nullptr)
    found_ = pave_way(prepared_, search, resolution, watch, run);
  else
    take(pave_closure(common(), search, resolution, watch, run));
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

ProofStatus BranchInPieces::certify_end(const std::string& path,
                                        const ProofPlacing& placing) const {
  return trajectory() != nullptr ? certify_way(path, prepared_, found_, placing)
                                 : certify_fold(path, common(), *end()->fold, placing);
}

}  // namespace regulus::detail
