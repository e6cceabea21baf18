// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/way_forces.hpp"

#include <algorithm>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/load/way_force_stage.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/pieces_alone.hpp"

namespace regulus::detail {
namespace {

class WayForceRun {
 public:
  WayForceRun(WayForces& found, const std::string& load, const SearchOptions& search,
              bool wants_trees, const PathWatch& watch)
      : found_(found), wants_trees_(wants_trees), stage_(found, load, search, wants_trees, watch) {}

  void run(double model_seconds) {
    stage_.search_all(model_seconds);
    std::vector<PieceForces>& pieces = stage_.pieces();
    if (!stage_.has_ended())
      ask_pieces_alone(
          pieces.size(), [&pieces](std::size_t k) { return !pieces[k].is_held; },
          [this](std::size_t k) {
            return stage_.must_stop(k) ? PieceAnswer::kStopped : search_alone(k);
          });
    if (found_.deciding) return;
    found_.excluded = std::size_t(std::ranges::count(pieces, false, &PieceForces::is_within));
    if (found_.excluded == pieces.size())
      found_.reason = Reason::kEmptyVariety;
    else
      found_.verdict = FeasibilityVerdict::kFeasible;
  }

 private:
  PieceAnswer search_alone(std::size_t k) {
    TreeKept* const tree = wants_trees_ ? &found_.trees[k] : nullptr;
    if (tree != nullptr) tree->clear();
    auto [prepared, result] = stage_.search_piece(
        k, 0, [](std::span<const Interval>, ForceClaim) {}, tree);
    if (result.verdict == FeasibilityVerdict::kFeasible || result.is_empty) {
      stage_.pieces()[k].is_within = !result.is_empty;
      return PieceAnswer::kProved;
    }
    const bool is_infeasible = result.verdict == FeasibilityVerdict::kInfeasible;
    const bool is_stopped = !is_infeasible && result.stopped_by.has_value();
    if (is_infeasible || !found_.deciding) {
      found_.verdict = result.verdict;
      found_.reason = result.reason;
      found_.deciding.emplace(DecidingForces{k, std::move(prepared), std::move(result)});
    }
    return is_infeasible ? PieceAnswer::kRefuted
           : is_stopped  ? PieceAnswer::kStopped
                         : PieceAnswer::kOpen;
  }

  WayForces& found_;
  const bool wants_trees_;
  WayForceStage stage_;
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

nlohmann::ordered_json checkpointed_question(const Request& request, const SearchOptions& search,
                                             const std::string& load) {
  nlohmann::ordered_json question = checkpointed_question(request, search);
  question["load"] = json_vector_set(choose_load(request.model, load),
                                     units_of_wrench(request.model, twist_of(request.model)));
  return question;
}

}  // namespace regulus::detail
