// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/trajectory/trajectory_run.hpp"

#include <fmt/format.h>

#include <limits>
#include <new>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/certificate/piece_question.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/trajectory_request.hpp"

namespace regulus::inline trajectory {
namespace {

/// After so many pieces without an answer, no more are searched for a singularity.
constexpr std::size_t kMostUndecided = 8;
constexpr std::uint64_t kMostBoxesAlone = 200'000;

/// Keeps splits and leaves as lines of a certificate.
class TreeLines final : public Observer {
 public:
  explicit TreeLines(PieceTree& tree) : tree_(tree) { tree_ = {}; }
  void on_split(const OpenBox&, const Split& split) noexcept override {
    append([&] { return fmt::format("s {} {} {:a}\n", split.parent, split.variable, split.at); });
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    append([&] { return fmt::format("l {} {}\n", box.id, certificate_word(rule)); });
    ++tree_.leaves;
  }
  /// False if there was no memory for a line.
  [[nodiscard]] bool is_whole() const noexcept { return is_whole_; }

 private:
  template <class Format>
  void append(Format format) noexcept try {
    tree_.lines += format();
  } catch (const std::bad_alloc&) {
    is_whole_ = false;
  }

  bool is_whole_ = true;
  PieceTree& tree_;
};

class TrajectoryRun {
 public:
  TrajectoryRun(TrajectoryCheck& check, const SearchOptions& search, bool wants_trees,
                const std::atomic<bool>* interrupt)
      : check_(check),
        search_(search),
        wants_trees_(wants_trees),
        interrupt_(interrupt),
        settings_(settings_from(search)) {
    settings_.interrupt = interrupt;
    settings_.uncertainty = Uncertainty::kElements;
    search_.boxes_before_compiling = 0;
  }

  void run() {
    const PathBounds path(*check_.request.motion.trajectory, check_.request.motion.error);
    FormingWatch watch;
    watch.interrupt = interrupt_;
    const double before = check_.seconds.model;
    check_.hull = prepare(hull_request(check_.request, path), before, search_, watch);
    check_.seconds = check_.hull.seconds_spent();
    if (check_.hull.stopped) return stop(0, check_.hull.stopped->interrupted);
    search_all(path);
    for (std::size_t k = 0; k < path.pieces() && !has_ended_; ++k)
      if (!check_.path.certified[k]) search_alone(k);
    if (has_ended_ || check_.deciding) return;
    check_.verdict = Verdict::kNoSingularity;
    check_.reason = Reason::kAllBoxesCertified;
  }

 private:
  void stop(std::size_t piece, bool interrupted) {
    end(piece, interrupted ? Reason::kInterrupted : Reason::kTimeBudget);
  }

  void end(std::size_t piece, Reason reason) {
    has_ended_ = true;
    check_.reason = reason;
    check_.deciding = DecidingPiece{piece, nullptr, {}};
  }

  [[nodiscard]] double seconds_left() const {
    const StageSeconds& s = check_.seconds;
    return settings_.time_limit - (s.model + s.symbolic + s.emit + s.compile + s.search);
  }

  void search_all(const PathBounds& path) {
    settings_.time_limit = std::max(0.0, seconds_left());
    if (find_fault(check_.hull.problem(), settings_)) return end(0, Reason::kBadProblem);
    const PathSearchOptions options{uncertain_names(check_.hull.labels).size(), wants_trees_};
    check_.path = search_path(path, check_.hull.problem(), settings_, options);
    check_.seconds.search = check_.path.statistics.seconds;
    if (check_.path.stopped_by) end(check_.path.stopped_at, *check_.path.stopped_by);
  }

  void search_alone(std::size_t k) {
    ++check_.searched_alone;
    auto preparation =
        std::make_unique<PreparedSearch>(prepare(piece_request(check_.request, k), 0, search_));
    Settings settings = settings_of(*preparation, search_, interrupt_);
    settings.time_limit = std::max(0.0, seconds_left());
    settings.max_boxes = std::min(settings.max_boxes, kMostBoxesAlone);
    PieceTree none;
    TreeLines lines(wants_trees_ ? check_.path.trees[k] : none);
    Result result = run_search(*preparation, search_, settings, &lines);
    add(preparation->seconds_spent(), result.statistics);
    if (wants_trees_ && !lines.is_whole()) throw std::bad_alloc();
    if (result.verdict == Verdict::kNoSingularity) {
      check_.path.certified[k] = true;
      return;
    }
    const bool is_singular = result.verdict == Verdict::kSingularity;
    const bool is_stopped = result.stopped_by == Reason::kInterrupted ||
                            (result.stopped_by == Reason::kTimeBudget && seconds_left() <= 0);
    if (is_singular || !check_.deciding) {
      check_.verdict = result.verdict;
      check_.reason = result.reason;
      check_.deciding = DecidingPiece{k, std::move(preparation), std::move(result)};
    }
    has_ended_ = is_singular || is_stopped || ++undecided_ == kMostUndecided;
  }

  void add(const StageSeconds& s, const Statistics& statistics) {
    check_.seconds.symbolic += s.symbolic + s.model;
    check_.seconds.emit += s.emit;
    check_.seconds.compile += s.compile;
    check_.seconds.search += s.search;
    Statistics& all = check_.path.statistics;
    all.boxes += statistics.boxes;
    all.max_frontier = std::max(all.max_frontier, statistics.max_frontier);
    for (std::size_t rule = 0; rule < kRules; ++rule) all.leaves[rule] += statistics.leaves[rule];
  }

  TrajectoryCheck& check_;
  SearchOptions search_;
  const bool wants_trees_;
  const std::atomic<bool>* const interrupt_;
  Settings settings_;
  std::size_t undecided_ = 0;
  bool has_ended_ = false;
};

}  // namespace

TrajectoryCheck check_trajectory(Request request, double model_seconds, SearchOptions search,
                                 bool wants_trees, const std::atomic<bool>* interrupt) {
  if (!search.filters.empty())
    throw UsageError("--filter: a motion along way-points is searched without filters");
  if (search.uncertainty != Uncertainty::kElements)
    throw UsageError(
        "--uncertainty: a motion along way-points keeps uncertain quantities whole; leave the "
        "option out");
  // A piece is decided by few boxes, so that a compiler would not pay.
  if (search.engine == Engine::kAuto) search.engine = Engine::kInterpreted;
  TrajectoryCheck check;
  check.request = std::move(request);
  check.engine = search.engine;
  check.seconds.model = model_seconds;
  TrajectoryRun(check, search, wants_trees, interrupt).run();
  return check;
}

}  // namespace regulus::trajectory
