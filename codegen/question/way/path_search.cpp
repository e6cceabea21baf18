// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_search.hpp"

#include <algorithm>
#include <chrono>

#include "runtime/problem/row_structure.hpp"
#include "runtime/search/leaf_claims.hpp"
#include "runtime/search/round.hpp"

namespace regulus {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostBatches = 64;

class PathSearch {
 public:
  PathSearch(const PathBounds& path, const Problem& problem, const Settings& settings,
             const PathSearchOptions& options)
      : settings_(settings),
        options_(options),
        structure_(find_row_structure(problem, settings)),
        round_(problem, settings, structure_),
        claims_(problem, options.reach),
        parts_(path, problem, {options.added, options.uncertain}, options.wants_trees),
        box_(problem.outer),
        boxes_(path.pieces()),
        blocked_(path.pieces(), false) {
    result_.certified.assign(path.pieces(), true);
    result_.leaves.resize(path.pieces());
  }

  PathSearchResult run() {
    round_.begin(deadline());
    open_.push_back(parts_.whole());
    while (!open_.empty() && !must_stop()) decide_round();
    for (const PathPart& part : open_) leave_open(part);
    result_.trees = parts_.take_trees();
    result_.statistics.seconds = seconds();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  [[nodiscard]] Clock::time_point deadline() const {
    const std::chrono::duration<double> limit(settings_.time_limit);
    if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
    return start_ + std::chrono::duration_cast<Clock::duration>(limit);
  }

  bool must_stop() {
    if (settings_.interrupt != nullptr && settings_.interrupt->load(std::memory_order_relaxed))
      result_.stopped_by = Reason::kInterrupted;
    else if (result_.statistics.boxes >= settings_.max_boxes)
      result_.stopped_by = Reason::kBoxBudget;
    else if (seconds() >= settings_.time_limit)
      result_.stopped_by = Reason::kTimeBudget;
    if (result_.stopped_by) result_.stopped_at = open_.back().piece;
    return result_.stopped_by.has_value();
  }

  void leave_open(const PathPart& part) {
    const std::size_t end = parts_.end_of(part);
    std::fill(result_.certified.begin() + std::ptrdiff_t(part.piece),
              result_.certified.begin() + std::ptrdiff_t(end), false);
  }

  void decide_round() {
    load_round();
    if (round_.size() == 0) {
      result_.stopped_by = Reason::kMemory;
      return;
    }
    if (!round_.decide(threshold_)) result_.stopped_by = Reason::kMemory;
    std::size_t at = 0;
    std::vector<PathPart> taken = std::move(taken_);
    taken_.clear();
    std::vector<PathPart> halves;
    for (std::size_t i = 0; i < round_.size(); ++i) {
      Decisions& batch = round_.batch(i);
      for (std::size_t t = 0; batch.decided && t < batch.budget.trials; ++t)
        threshold_.learn(batch.budget.trial[t]);
      for (std::size_t lane = 0; lane < batch.count(); ++lane, ++at) {
        if (batch.decided)
          settle(taken[at], batch.decision[lane], halves);
        else
          halves.push_back(std::move(taken[at]));
      }
    }
    open_.insert(open_.end(), std::make_move_iterator(halves.rbegin()),
                 std::make_move_iterator(halves.rend()));
    result_.statistics.max_frontier =
        std::max<std::uint64_t>(result_.statistics.max_frontier, open_.size());
  }

  void load_round() {
    round_.clear();
    while (!open_.empty() && round_.size() < kMostBatches) {
      Decisions* batch = round_.append();
      if (batch == nullptr) return;
      while (!open_.empty() && batch->count() < kLanes) {
        PathPart part = std::move(open_.back());
        open_.pop_back();
        if ((part.pieces == 1 && blocked_[part.piece]) || is_skipped(part)) continue;
        parts_.load_box(part, box_);
        batch->add({part.id, part.depth, box_});
        taken_.push_back(std::move(part));
        ++result_.statistics.boxes;
      }
    }
  }

  [[nodiscard]] bool is_skipped(const PathPart& part) const {
    if (options_.skipped == nullptr) return false;
    const std::size_t end = parts_.end_of(part);
    const auto first = options_.skipped->begin();
    return std::all_of(first + std::ptrdiff_t(part.piece), first + std::ptrdiff_t(end),
                       [](bool skipped) { return skipped; });
  }

  void settle(PathPart& part, const Decision& decision, std::vector<PathPart>& halves) {
    const bool is_leaf = decision.kind == Decision::Kind::kLeaf;
    if (is_leaf && decision.rule != Rule::kBlocked) return certify(part, decision.rule);
    if (part.pieces > 1) return parts_.split_group(part, halves);
    if (is_leaf || ++boxes_[part.piece] > options_.most_boxes) return block(part);
    if (!parts_.split(part, decision.variable, halves)) block(part);
  }

  void certify(const PathPart& part, Rule rule) {
    ++result_.statistics.leaves[static_cast<std::size_t>(rule)];
    const std::size_t end = parts_.end_of(part);
    const Claim claim = claim_of_leaf(part, rule);
    for (std::size_t k = part.piece; k < end; ++k) {
      result_.leaves[k].within |= claim == Claim::kFree;
      result_.leaves[k].outside |= claim == Claim::kOutside;
      result_.leaves[k].out_of_reach |= claim == Claim::kUnreachable;
    }
    parts_.leaf(part, rule);
  }

  [[nodiscard]] Claim claim_of_leaf(const PathPart& part, Rule rule) {
    if (rule != Rule::kOutside) return Claim::kFree;
    parts_.load_box(part, box_);
    return claims_.of(box_, rule);
  }

  void block(const PathPart& part) {
    blocked_[part.piece] = true;
    result_.certified[part.piece] = false;
  }

  const Settings& settings_;
  const PathSearchOptions& options_;
  const Clock::time_point start_ = Clock::now();
  const RowStructure structure_;
  Round round_;
  AdaptiveThreshold threshold_;
  LeafClaims claims_;
  PathParts parts_;
  std::vector<Interval> box_;
  std::vector<std::uint32_t> boxes_;  ///< evaluated in each piece
  std::vector<bool> blocked_;
  std::vector<PathPart> open_, taken_;
  PathSearchResult result_;
};

}  // namespace

PathSearchResult search_path(const PathBounds& path, const Problem& problem,
                             const Settings& settings, const PathSearchOptions& options) {
  return PathSearch(path, problem, settings, options).run();
}

}  // namespace regulus
