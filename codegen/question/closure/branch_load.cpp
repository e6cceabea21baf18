// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_load.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "codegen/answer/report/progress.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/load/force_problem.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kBranch = "branch";
constexpr const char* kForces = "forces";
constexpr const char* kBranchEnds =
    "the branch ends in the motion, where a motor may need any force";

/// f is how far a force is beyond its limits: it is at most 0, or not.
constexpr double kBeyond = std::numeric_limits<double>::denorm_min();
constexpr ValueAim kWithinLimits{.below = kBeyond, .from = kBeyond};

/// The two searches: of the branch, and of the forces over it.
class LoadRun {
 public:
  LoadRun(PreparedBranchLoad& prepared, const BranchLoadRun& run)
      : prepared_(prepared),
        branch_(prepared.branch),
        closure_(branch_.common()),
        run_(run),
        budget_(TimeBudget::of_option(prepared.search.time_limit)),
        value_(prepared.value()) {
    watch_.interrupt = run.interrupt;
  }

  BranchLoadResult check() {
    SearchDisplay display(run_.output);
    branch_.follow(prepared_.search, watch_,
                   run_of(TopicKind::kBranch, kBranch, display.observer()));
    note_branch();
    if (!branch_.is_proved()) return without_branch();
    find_forces();
    finish(false);
    return std::move(result_);
  }

  BranchLoadResult pave(double resolution, const PieceForceListener& listener, Observer* progress) {
    branch_.pave(prepared_.search, resolution, watch_,
                 run_of(TopicKind::kBranch, kBranch, nullptr));
    note_branch();
    const bool is_whole = !result_.stopped_by;
    result_.paved =
        pave_pieces(branch_.reached(), value_, kWithinLimits, resolution, is_whole, limits(),
                    run_of(TopicKind::kQuestion, kForces, progress), listener);
    bool is_feasible = result_.paved.size() == branch_.pieces(), is_empty = is_feasible;
    for (std::size_t k = 0; k < result_.paved.size(); ++k) {
      const BranchPaving& paving = result_.paved[k];
      note_search(paving.boxes, paving.seconds, paving.stopped_by);
      if (paving.place && !result_.shortage) show_shortage(k, *paving.place, paving.at);
      is_feasible = is_feasible && paving.is_feasible;
      is_empty = is_empty && paving.is_empty;
    }
    result_.is_empty = is_empty;
    if (!result_.shortage && is_feasible && !is_empty)
      result_.verdict = FeasibilityVerdict::kFeasible;
    else if (!result_.shortage)
      result_.reason = reason_of_paving();
    finish(true);
    return std::move(result_);
  }

 private:
  [[nodiscard]] PiecesRun run_of(TopicKind kind, const char* name, Observer* progress) const {
    PiecesRun run{progress, {}, {}};
    run.topic.kind = kind;
    if (run_.checkpoint != nullptr)
      run.kept = {run_.checkpoint->file(), run_.checkpoint->interval(), name};
    return run;
  }

  [[nodiscard]] std::string reason_of_paving() const {
    if (result_.is_empty) return describe(Reason::kEmptyVariety);
    if (result_.stopped_by) return describe(*result_.stopped_by);
    if (branch_.trajectory() == nullptr || branch_.is_proved()) return describe(Reason::kWidth);
    return branch_.end() != nullptr ? kBranchEnds : branch_.obstacle();
  }

  [[nodiscard]] BoxSearchSettings limits() const {
    BoxSearchSettings settings = settings_of(closure_, prepared_.search, run_.interrupt);
    settings.time_limit = budget_.left();
    return settings;
  }

  void note_branch() {
    result_.boxes = branch_.boxes();
    result_.stopped_by = branch_.stopped_by();
    result_.is_empty = branch_.is_empty();
  }
  void note_search(std::uint64_t boxes, double seconds, std::optional<Reason> stopped_by) {
    result_.boxes += boxes;
    closure_.preparation.seconds.search += seconds;
    if (!result_.stopped_by) result_.stopped_by = stopped_by;
  }

  BranchLoadResult without_branch() {
    result_.reason = branch_.end() != nullptr ? kBranchEnds
                     : result_.is_empty       ? describe(Reason::kEmptyVariety)
                                              : branch_.obstacle();
    finish(false);
    return std::move(result_);
  }

  void find_forces() {
    SearchDisplay display(run_.output);
    BracketOfPieces found =
        bracket_values(branch_.reached(), value_, kWithinLimits, limits(),
                       run_of(TopicKind::kQuestion, kForces, display.observer()));
    note_search(found.boxes, found.seconds, found.stopped_by);
    if (found.attained >= *kWithinLimits.from)
      show_shortage(found.piece, *found.place, found.at);
    else if (found.upper < *kWithinLimits.below)
      result_.verdict = FeasibilityVerdict::kFeasible;
    else
      result_.reason = found.stopped_by
                           ? describe(*found.stopped_by)
                           : "a force is too near its limit, or boxes at the least width are too "
                             "wide to decide";
    result_.trees = std::move(found.trees);
  }

  /// The verdict is that of the search, which has shown it; the numbers are for people.
  void show_shortage(std::size_t piece, const BranchTube& tube,
                     const std::vector<Interval>& place) {
    result_.verdict = FeasibilityVerdict::kInfeasible;
    ValuesAtPlace at = values_at(branch_.reached(), piece, tube, place, &value_);
    result_.shortage = BranchShortage{piece, place, std::move(at.unknowns),
                                      std::move(at.beyond).value_or(ForceBeyond{})};
  }

  void finish(bool paves) {
    if (run_.checkpoint == nullptr) return;
    const bool is_open = result_.verdict == FeasibilityVerdict::kPossibleProblem;
    run_.checkpoint->finish(result_.stopped_by.has_value() && (paves || is_open));
  }

  PreparedBranchLoad& prepared_;
  BranchInPieces& branch_;
  PreparedClosure& closure_;
  const BranchLoadRun& run_;
  const TimeBudget budget_;
  const BranchValue value_;
  FormingWatch watch_;
  BranchLoadResult result_;
};

}  // namespace

PreparedBranchLoad prepare_branch_load(const Request& request, double model_seconds,
                                       const std::string& load, const SearchOptions& search,
                                       const FormingWatch& watch) {
  const std::string name = choose_load(request.model, load).name;
  std::vector<Interval> limits = certain_limits(request.model);
  // It says what is wrong with the units.
  static_cast<void>(quantity_of(request.model, {.quantity = "force", .load = name}));
  return {BranchInPieces(request, model_seconds, search, watch, DerivativesBy::kVariablesAndPose),
          search, name, request.model.actuators.force_unit, std::move(limits)};
}

BranchLoadResult check_branch_load(PreparedBranchLoad& prepared, const BranchLoadRun& run) {
  return LoadRun(prepared, run).check();
}

ProofStatus certify_load(const std::string& path, const PreparedBranchLoad& prepared,
                         const BranchLoadResult& result, const ProofPlacing& placing) {
  if (result.verdict == FeasibilityVerdict::kPossibleProblem) {
    ProofStatus status(path);
    if (status.is_wanted()) status.set_obstacle(kNothingClaimed);
    return status;
  }
  if (result.shortage)
    return certify_forces(path, prepared.branch.reached().proved(), prepared.set(),
                          PlaceOfValue{result.shortage->piece, result.shortage->place}, placing);
  return certify_forces(path, prepared.branch.reached().proved(result.trees), prepared.set(),
                        std::nullopt, placing);
}

ProofStatus certify_load_paving(const std::string& path, const PreparedBranchLoad& prepared,
                                const BranchLoadResult& result, const ProofPlacing& placing) {
  std::vector<PavedTree> trees;
  for (const BranchPaving& piece : result.paved) trees.push_back({&piece.tree, piece.words});
  trees.resize(prepared.branch.pieces());
  return certify_paved_forces(path, prepared.branch.reached().proved(), prepared.set(), trees,
                              placing);
}

BranchLoadResult pave_branch_load(PreparedBranchLoad& prepared, double resolution,
                                  const BranchLoadRun& run, const PieceForceListener& listener,
                                  Observer* progress) {
  return LoadRun(prepared, run).pave(resolution, listener, progress);
}

/// The model's digest is in it.
nlohmann::ordered_json checkpointed_question(const PreparedBranchLoad& prepared,
                                             std::optional<double> resolution) {
  nlohmann::ordered_json question =
      checkpointed_question(prepared.branch.way().request, prepared.search);
  question["closure"] = prepared.closure().shape.unknowns;
  question["load"] = prepared.load;
  if (resolution) question["resolution"] = *resolution;
  return question;
}

}  // namespace regulus::detail
