// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_run.hpp"

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/way/path_run.hpp"
#include "runtime/search/conclusion.hpp"

namespace regulus {
namespace {

/// After so many pieces without an answer, no more are searched for a singularity.
constexpr std::size_t kMostUndecided = 8;

class TrajectoryRun {
 public:
  TrajectoryRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
                const std::atomic<bool>* interrupt)
      : check_(check),
        search_(search),
        wants_trees_(wants_trees),
        run_(check, search, wants_trees, interrupt) {}

  void run() {
    run_.search_all();
    const std::size_t pieces = check_.request.motion.trajectory->pieces.size();
    for (std::size_t k = 0; k < pieces && !has_ended(); ++k)
      if (!check_.path.certified[k]) search_alone(k);
    if (has_ended() || check_.deciding) return;
    const bool is_empty = excluded_everywhere(check_.path.statistics);
    check_.verdict = is_empty ? Verdict::kPossibleProblem : Verdict::kNoSingularity;
    check_.reason = is_empty ? Reason::kEmptyVariety : Reason::kAllBoxesCertified;
  }

 private:
  [[nodiscard]] bool has_ended() const { return has_ended_ || run_.has_ended(); }

  void search_alone(std::size_t k) {
    ++check_.searched_alone;
    auto preparation = run_.prepare_piece(k);
    TreeKept* const tree = wants_trees_ ? &check_.path.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    Result result = run_search(*preparation, search_, run_.settings_of_piece(*preparation), tree);
    run_.add(*preparation, result.statistics);
    if (result.verdict == Verdict::kNoSingularity || result.reason == Reason::kEmptyVariety) {
      note_certified(k, result);
      return;
    }
    const bool is_singular = result.verdict == Verdict::kSingularity;
    const bool is_stopped = run_.is_cut_short(result);
    if (is_singular || !check_.deciding) {
      check_.verdict = result.verdict;
      check_.reason = result.reason;
      check_.deciding = DecidingPiece{k, std::move(preparation), std::move(result)};
    }
    has_ended_ = is_singular || is_stopped || ++undecided_ == kMostUndecided;
  }

  /// A piece without a pose that the constraints allow proves nothing and needs no proof.
  void note_certified(std::size_t k, const Result& result) {
    check_.path.certified[k] = true;
    const bool is_excluded = result.reason == Reason::kEmptyVariety;
    check_.path.leaves[k] = {!is_excluded, is_excluded, false};
  }

  TrajectoryCheck& check_;
  const SearchOptions& search_;
  const bool wants_trees_;
  PathRun run_;
  std::size_t undecided_ = 0;
  bool has_ended_ = false;
};

}  // namespace

TrajectoryCheck check_trajectory(Request request, double model_seconds, SearchOptions search,
                                 bool wants_trees, const std::atomic<bool>* interrupt) {
  TrajectoryCheck check = begin_check(std::move(request), model_seconds, search);
  TrajectoryRun(check, search, wants_trees, interrupt).run();
  return check;
}

}  // namespace regulus
