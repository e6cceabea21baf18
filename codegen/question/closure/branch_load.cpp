// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_load.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/question/closure/load_paving.hpp"
#include "codegen/question/closure/uncertain_values.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/load/force_problem.hpp"
#include "codegen/support/time_budget.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {
namespace {

constexpr const char* kBranch = "branch";
constexpr const char* kForces = "forces";

/// Runs a search with its place in the checkpoint, if there is one.
template <class BoxSettings, class Search>
auto kept(SearchCheckpoint* checkpoint, BoxSettings settings, const Search& search,
          const char* place) {
  JsonCheckpoint* const file = checkpoint == nullptr ? nullptr : checkpoint->file();
  if (file == nullptr) return search(settings);
  settings.save_every = checkpoint->interval();
  return file->continue_search(settings, search, place);
}

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
    turn(TopicKind::kBranch);
    branch_.follow(prepared_.search, watch_, display.observer(), keep_branch());
    note_branch();
    if (!branch_.is_proved()) return without_branch();
    find_forces();
    finish(false);
    return std::move(result_);
  }

  BranchLoadResult pave(double resolution, const ForceListener& listener, Observer* progress) {
    turn(TopicKind::kBranch);
    branch_.take(
        pave_closure(closure_, prepared_.search, resolution, watch_, nullptr, keep_branch()));
    note_branch();
    turn(TopicKind::kQuestion);
    const auto search = [&](const BoxSearchSettings& chosen) {
      return pave_forces(question(), branch_.found().pieces.front(), resolution, chosen,
                         is_possible(), listener, progress);
    };
    // Another run may have another branch, if this one is not whole.
    const LoadPaving paving =
        result_.stopped_by ? search(limits()) : kept(run_.checkpoint, limits(), search, kForces);
    note_search(paving.boxes, paving.seconds, paving.stopped_by);
    result_.is_empty = paving.is_empty;
    if (paving.place) {
      show_shortage(0, *paving.place, paving.at);
    } else if (paving.is_feasible && !paving.is_empty) {
      result_.verdict = FeasibilityVerdict::kFeasible;
    } else {
      result_.reason = result_.is_empty     ? describe(Reason::kEmptyVariety)
                       : result_.stopped_by ? describe(*result_.stopped_by)
                                            : describe(Reason::kWidth);
    }
    finish(true);
    return std::move(result_);
  }

 private:
  void turn(TopicKind kind) const {
    SearchTopic topic;
    topic.kind = kind;
    turn_to(prepared_.search.workers, std::move(topic), closure_.request.motion);
  }

  [[nodiscard]] KeepBranch keep_branch() const {
    return [this](const BranchSettings& settings, const SearchOfBranch& search) {
      return kept(run_.checkpoint, settings, search, kBranch);
    };
  }

  [[nodiscard]] ValueQuestion question() const {
    return {closure_.problem, closure_.question(), value_};
  }
  [[nodiscard]] IsPossible is_possible() {
    return [this](const std::vector<Interval>& point) {
      return is_in_motion(closure_, system_, point);
    };
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
    result_.reason = branch_.end() != nullptr
                         ? "the branch ends in the motion, where a motor may need any force"
                     : result_.is_empty ? describe(Reason::kEmptyVariety)
                                        : branch_.obstacle();
    finish(false);
    return std::move(result_);
  }

  void find_forces() {
    // f is how far a force is beyond its limits: it is at most 0, or not.
    constexpr double kBeyond = std::numeric_limits<double>::denorm_min();
    const ValueAim aim{0, kBeyond, kBeyond};
    SearchDisplay display(run_.output);
    turn(TopicKind::kQuestion);
    const auto search = [&](const BoxSearchSettings& chosen) {
      return branch_.bracket(value_, aim, chosen, display.observer());
    };
    BracketOfPieces found = kept(run_.checkpoint, limits(), search, kForces);
    note_search(found.boxes, found.seconds, found.stopped_by);
    if (found.attained >= kBeyond)
      show_shortage(found.piece, *found.place, found.at);
    else if (found.upper < kBeyond)
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
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    const Problem problem = branch_.way().problem_of(piece);
    SystemBoxes system(problem, closure_.scaling, closure_.shape);
    TubeFinder finder(system, closure_.shape, closure_.ranges);
    const TubeTrial trial{place, tube, {}};
    const auto measured = finder.measure({&trial, 1});
    BranchShortage& shortage = result_.shortage.emplace();
    shortage.piece = piece;
    shortage.place = place;
    shortage.unknowns = enclose(tube, place);
    if (!measured.front()) return;
    const BranchRates rates(tube, measured.front()->image, measured.front()->inverse,
                            measured.front()->over.by_unknown);
    shortage.beyond = value_.farthest_beyond(rates, measured.front()->over);
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
  SystemBoxes system_{closure_.problem, closure_.scaling, closure_.shape};
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
    return certify_forces(path, prepared.branch.proved(), prepared.set(),
                          PlaceOfValue{result.shortage->piece, result.shortage->place}, placing);
  return certify_forces(path, prepared.branch.proved(result.trees), prepared.set(), std::nullopt,
                        placing);
}

BranchLoadResult pave_branch_load(PreparedBranchLoad& prepared, double resolution,
                                  const BranchLoadRun& run, const ForceListener& listener,
                                  Observer* progress) {
  return LoadRun(prepared, run).pave(resolution, listener, progress);
}

/// The model's digest is in it.
nlohmann::ordered_json checkpointed_question(const PreparedBranchLoad& prepared,
                                             std::optional<double> resolution) {
  nlohmann::ordered_json question = json_question(prepared.closure().request, prepared.search);
  question.erase("options");  // they change how long it takes
  question["closure"] = prepared.closure().shape.unknowns;
  question["load"] = prepared.load;
  if (resolution) question["resolution"] = *resolution;
  return question;
}

}  // namespace regulus
