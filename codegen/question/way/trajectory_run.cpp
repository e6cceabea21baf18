// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_run.hpp"

#include "codegen/question/way/path_run.hpp"
#include "runtime/search/conclusion.hpp"

namespace regulus::detail {
namespace {

class TrajectoryRun {
 public:
  TrajectoryRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
                const PathWatch& watch)
      : check_(check), wants_trees_(wants_trees), run_(check, search, wants_trees, watch) {}

  void run() {
    run_.search_all();
    if (run_.has_ended()) return;
    ask_pieces_alone(
        check_.request.motion.trajectory->pieces.size(),
        [this](std::size_t k) { return !check_.path.certified[k]; },
        [this](std::size_t k) { return search_alone(k); });
    if (check_.deciding) return;
    const bool is_empty = excluded_everywhere(check_.path.statistics);
    check_.verdict = is_empty ? Verdict::kPossibleProblem : Verdict::kNoSingularity;
    check_.reason = is_empty ? Reason::kEmptyVariety : Reason::kAllBoxesCertified;
  }

 private:
  PieceAnswer search_alone(std::size_t k) {
    ++check_.searched_alone;
    auto preparation = run_.prepare_piece(k);
    TreeKept* const tree = wants_trees_ ? &check_.path.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    Result result = run_.search_piece(k, *preparation, run_.settings_of_piece(*preparation), tree);
    if (result.verdict == Verdict::kNoSingularity || result.reason == Reason::kEmptyVariety) {
      note_certified(k, result);
      return PieceAnswer::kProved;
    }
    const bool is_singular = result.verdict == Verdict::kSingularity;
    const bool is_stopped = run_.is_cut_short(result);
    if (is_singular || !check_.deciding) {
      check_.verdict = result.verdict;
      check_.reason = result.reason;
      check_.deciding = DecidingPiece{k, std::move(preparation), std::move(result)};
    }
    return is_singular  ? PieceAnswer::kRefuted
           : is_stopped ? PieceAnswer::kStopped
                        : PieceAnswer::kOpen;
  }

  /// A piece without a pose that the constraints allow proves nothing and needs no proof.
  void note_certified(std::size_t k, const Result& result) {
    check_.path.certified[k] = true;
    const bool is_excluded = result.reason == Reason::kEmptyVariety;
    check_.path.leaves[k] = {!is_excluded, is_excluded, false};
  }

  TrajectoryCheck& check_;
  const bool wants_trees_;
  PathRun run_;
};

}  // namespace

TrajectoryCheck check_trajectory(Request request, double model_seconds, SearchOptions search,
                                 bool wants_trees, const PathWatch& watch) {
  TrajectoryCheck check = begin_check(std::move(request), model_seconds, search);
  TrajectoryRun(check, search, wants_trees, watch).run();
  return check;
}

}  // namespace regulus::detail
