// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_run.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/kept_search.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/trajectory_request.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

constexpr std::uint64_t kMostBoxesAlone = 200'000;

}  // namespace

PathRun::PathRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
                 const PathWatch& watch)
    : check_(check),
      search_(search),
      wants_trees_(wants_trees),
      watch_(watch),
      settings_(settings_from(search)) {
  settings_.interrupt = watch.interrupt;
  settings_.uncertainty = Uncertainty::kElements;
  search_.boxes_before_compiling = 0;
}

void PathRun::search_all() {
  const PathBounds path(*check_.request.motion.trajectory, check_.request.motion.error);
  FormingWatch watch;
  watch.interrupt = watch_.interrupt;
  const double before = check_.seconds.model;
  check_.hull = prepare(hull_request(check_.request, path), before, search_, watch);
  check_.seconds = check_.hull.seconds_spent();
  if (check_.hull.stopped)
    return end(0, check_.hull.stopped->interrupted ? Reason::kInterrupted : Reason::kTimeBudget);
  settings_.time_limit = std::max(0.0, seconds_left());
  if (find_fault(check_.hull.problem(), settings_)) return end(0, Reason::kBadProblem);
  PathSearchOptions options{check_.request.motion.parameters.size(),
                            uncertain_names(check_.hull.labels).size(), wants_trees_,
                            check_.hull.labels.reach};
  options.progress = watch_.display;
  options.checkpoint = watch_.checkpoint;
  turn_to_piece(search_.workers, watch_.topic, check_.request.motion, std::nullopt);
  check_.path = search_path(path, check_.hull.problem(), settings_, options);
  check_.seconds.search = check_.path.statistics.seconds;
  if (check_.path.stopped_by) end(check_.path.stopped_at, *check_.path.stopped_by);
}

std::unique_ptr<PreparedSearch> PathRun::prepare_piece(std::size_t piece) const {
  return std::make_unique<PreparedSearch>(
      prepare(piece_request(check_.request, piece), 0, search_));
}

Settings PathRun::settings_of_piece(const PreparedSearch& preparation) const {
  Settings settings = settings_of(preparation, search_, watch_.interrupt);
  settings.time_limit = std::max(0.0, seconds_left());
  settings.max_boxes = std::min(settings.max_boxes, kMostBoxesAlone);
  return settings;
}

Result PathRun::search_piece(std::size_t piece, PreparedSearch& preparation,
                             const Settings& settings, Observer* observer) {
  turn_to_piece(search_.workers, watch_.topic, check_.request.motion, piece);
  Observers observers(present({observer, watch_.display}));
  KeptSearch kept(watch_.file(), place_of_piece(piece), watch_.interval());
  Result result = kept.run(preparation, search_, settings, observers);
  add(preparation, result.statistics);
  const bool is_at_own_limit =
      result.stopped_by == Reason::kBoxBudget && settings.max_boxes == kMostBoxesAlone;
  if (result.stopped_by && result.stopped_by != Reason::kStalled && !is_at_own_limit)
    check_.can_continue = true;
  return result;
}

void PathRun::add(const PreparedSearch& preparation, const Statistics& statistics) {
  const StageSeconds s = preparation.seconds_spent();
  check_.seconds.symbolic += s.symbolic + s.model;
  check_.seconds.program += s.program;
  check_.seconds.emit += s.emit;
  check_.seconds.compile += s.compile;
  check_.seconds.search += statistics.seconds;
  Statistics& all = check_.path.statistics;
  all.boxes += statistics.boxes;
  all.max_frontier = std::max(all.max_frontier, statistics.max_frontier);
  for (std::size_t rule = 0; rule < kRules; ++rule) all.leaves[rule] += statistics.leaves[rule];
}

void PathRun::end(std::size_t piece, Reason reason) {
  has_ended_ = true;
  check_.reason = reason;
  check_.deciding = DecidingPiece{piece, nullptr, {}};
  check_.can_continue = reason != Reason::kBadProblem && reason != Reason::kMemory;
}

double PathRun::seconds_left() const {
  const double spent = check_.seconds.before_search() + check_.seconds.search;
  const double limit = search_.time_limit == 0 ? kInfinity : search_.time_limit;
  return limit - spent;
}

bool PathRun::is_cut_short(const Result& result) const {
  return result.stopped_by == Reason::kInterrupted ||
         (result.stopped_by == Reason::kTimeBudget && seconds_left() <= 0);
}

std::string place_of_piece(std::size_t piece) { return "segment " + std::to_string(piece + 1); }

void settle_options(SearchOptions& search) {
  if (!search.filters.empty())
    throw UsageError("--filter: a motion along way-points is searched without filters");
  if (!search.weights.empty())
    throw UsageError("--weight: a motion along way-points has no ranges to weigh");
  if (!search.kernel.empty())
    throw UsageError(
        "--kernel: a motion along way-points has a kernel for each segment; leave the option out");
  if (search.uncertainty != Uncertainty::kElements)
    throw UsageError(
        "--uncertainty: a motion along way-points keeps uncertain quantities whole; leave the "
        "option out");
  // A piece is decided by few boxes, so that a compiler would not pay.
  if (search.engine == Engine::kAuto) search.engine = Engine::kInterpreted;
}

TrajectoryCheck begin_check(Request request, double model_seconds, SearchOptions& search) {
  settle_options(search);
  TrajectoryCheck check;
  check.request = std::move(request);
  check.engine = search.engine;
  check.seconds.model = model_seconds;
  return check;
}

}  // namespace regulus::detail
