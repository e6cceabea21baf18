// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/kept_search.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/search/retold_tree.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kState = "state";
/// The question is in the file itself (JsonCheckpoint).
constexpr std::size_t kDigits = 64;

class NoBoxes final : public OpenBoxes {
 public:
  [[nodiscard]] std::size_t size() const noexcept override { return 0; }
  [[nodiscard]] OpenBox at(std::size_t) const noexcept override { return {}; }
};

using Clock = std::chrono::steady_clock;

/// A time that no clock will reach is none.
Clock::time_point time_after(double seconds) {
  const std::chrono::duration<double> limit(seconds);
  if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

/// The boxes that are left must be the same in both texts, and those that were evaluated as many as the
/// tree has: each was split or is a leaf.
void require_same_boxes(const Checkpoint& state, const RestoredTree& tree) {
  const std::vector<OpenBox> open = state.open();
  const std::size_t closed = tree.leaves().size() - tree.open();
  if (open.size() != tree.open() || state.state.next_id != tree.size())
    throw SavedTreeError("other boxes are left");
  if (state.state.statistics.boxes != tree.steps().size())
    throw SavedTreeError("it counts another number of boxes than it has");
  for (std::size_t i = 0; i < open.size(); ++i) {
    const BoxId id = tree.leaves()[closed + i].box;
    if (open[i].id != id || open[i].depth != tree.depth(id) ||
        !std::ranges::equal(open[i].box, tree.box(id)))
      throw SavedTreeError("box " + std::to_string(id) + " is another one");
  }
}

/// Counts only boxes that the tree has. Those that are open again will be evaluated again.
void recount(SearchState& state, const RetoldTree& told, const RestoredTree& tree) {
  Statistics& statistics = state.statistics;
  statistics.boxes -= told.reopened.size();
  statistics.max_frontier = std::min<std::uint64_t>(statistics.max_frontier, tree.leaves().size());
  state.boxes_when_blocked = std::min(state.boxes_when_blocked, statistics.boxes);
  Headway::Run run = state.headway.run();
  run.begin = std::min(run.begin, statistics.boxes);
  state.headway = Headway(run);
}

/// Takes the facts about leaves from those that were judged again.
void correct(Checkpoint& from, const RetoldTree& told, const RestoredTree& tree) {
  SearchState& state = from.state;
  recount(state, told, tree);
  state.statistics.leaves = told.leaves;
  state.filter_boxes = told.filter_boxes;
  state.witness = told.witness;
  state.witness_reason = told.witness_reason;
  state.blocked = told.blocked.has_value();
  if (told.blocked) {
    state.blocked_reason = told.blocked_reason;
    state.blocking_box = tree.box(*told.blocked);
  }
  if (told.reopened.empty()) return;
  state.units.clear();  // they do not have these boxes
  for (const BoxId id : told.reopened) {
    const std::vector<Interval> box = tree.box(id);
    from.ids.push_back(id);
    from.depths.push_back(tree.depth(id));
    from.boxes.insert(from.boxes.end(), box.begin(), box.end());
  }
}

}  // namespace

KeptSearch::KeptSearch(JsonCheckpoint* file, std::string place, double interval)
    : file_(file), place_(std::move(place)), pace_(interval) {}

Result KeptSearch::run(PreparedSearch& preparation, const SearchOptions& search,
                       const Settings& settings, Observer& observer) {
  if (file_ == nullptr) return run_search(preparation, search, settings, &observer);
  observer_ = &observer;
  const regulus_kernel& kernel = preparation.kernel->functions();
  question_.identity = std::string(kDigits, '0');
  question_.splittable =
      settings.uncertainty == Uncertainty::kVariables ? kernel.variables : kernel.motion_variables;
  question_.ranges = preparation.variety.outer;
  Settings own = settings;
  interrupt_ = std::exchange(own.interrupt, &stop_);
  deadline_ = time_after(std::exchange(own.time_limit, std::numeric_limits<double>::infinity()));
  Result result = run_here(preparation, search, own);
  if (result.stopped_by == Reason::kInterrupted && !is_interrupted()) {
    result.stopped_by = Reason::kTimeBudget;
    if (result.reason == Reason::kInterrupted) result.reason = Reason::kTimeBudget;
  }
  const bool is_decided = settings.exhaustive || result.verdict == Verdict::kNoSingularity ||
                          result.reason == Reason::kEmptyVariety;
  if (!result.stopped_by && is_decided) save_end(result);
  return result;
}

Result KeptSearch::run_here(PreparedSearch& preparation, const SearchOptions& search,
                            const Settings& settings) {
  if (!file_->known().contains(place_)) return run_search(preparation, search, settings, this);
  return continue_search(preparation, search, settings, this,
                         [this](const Problem& problem, Settings& of_search, Observer& observers) {
                           return restore(problem, of_search, observers);
                         });
}

/// `observers`: this one, and what watches for a kernel that is faster.
Checkpoint KeptSearch::restore(const Problem& problem, Settings& settings,
                               Observer& observers) try {
  Stopwatch watch;
  const SavedTree saved = *file_->tree(place_);
  const RestoredTree tree(saved, problem.outer, question_.splittable);
  Checkpoint from = read_state();
  require_same_boxes(from, tree);
  on_start(problem, settings);
  const RetoldTree told = tell_again(tree, problem, settings, observers);
  correct(from, told, tree);
  is_whole_ = is_whole_ && told.is_complete;
  from.state.statistics.seconds = watch.lap();
  if (!told.is_complete) settings.time_limit = 0;
  return from;
} catch (const SavedTreeError& error) {
  file_->refuse_tree(error);
}

Checkpoint KeptSearch::read_state() const try {
  const std::string text = file_->known().at(place_).at(kState).get<std::string>();
  return read_checkpoint(text, question_);
} catch (const nlohmann::json::exception& error) {
  throw SavedTreeError(error.what());
} catch (const CheckpointError& error) {
  throw SavedTreeError(error.what());
}

void KeptSearch::on_start(const Problem& problem, const Settings& settings) noexcept {
  if (!has_started_) observer_->on_start(problem, settings);
  has_started_ = true;
}

void KeptSearch::on_split(const OpenBox& box, const Split& split) noexcept {
  try {
    tree_.add_split(box.id, split.variable);
  } catch (const std::bad_alloc&) {
    is_whole_ = false;
  }
  next_id_ = split.lower + 2;
  observer_->on_split(box, split);
}

void KeptSearch::on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept {
  try {
    tree_.add_leaf(box.id, bound_of_leaf(rule, proof.reason));
  } catch (const std::bad_alloc&) {
    is_whole_ = false;
  }
  observer_->on_leaf(box, rule, proof);
}

void KeptSearch::on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept {
  observer_->on_progress(statistics, frontier);
  if (is_interrupted() || Clock::now() >= deadline_) stop_ = true;
}

bool KeptSearch::wants_pause() noexcept {
  const bool is_wanted = observer_->wants_pause();
  return is_wanted || pace_.is_due();
}

void KeptSearch::on_pause(const SearchState& state, const OpenBoxes& open) noexcept {
  observer_->on_pause(state, open);
  pace_.pass([&] {
    try {
      if (is_whole_) save(state, open);
    } catch (const std::exception&) {  // the file keeps what it had
    }
  });
}

void KeptSearch::save(const SearchState& state, const OpenBoxes& open) {
  tree_.open.clear();
  for (std::size_t i = 0; i < open.size(); ++i)
    tree_.add_open(open.at(i).id, std::numeric_limits<double>::infinity());
  file_->known()[place_][kState] = write_checkpoint(question_, state, open);
  file_->keep(tree_, place_);
}

/// A search that has ended is not searched again, but judged.
void KeptSearch::save_end(const Result& result) {
  if (!is_whole_) return;
  SearchState state;
  state.next_id = next_id_;
  state.statistics = result.statistics;
  state.filter_boxes = result.filter_boxes;
  save(state, NoBoxes());
}

}  // namespace regulus::detail
