// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_search.hpp"

#include <algorithm>

#include "runtime/problem/row_structure.hpp"
#include "runtime/search/box_search.hpp"
#include "runtime/search/leaf_claims.hpp"
#include "runtime/search/round.hpp"

namespace regulus {
namespace {

constexpr std::size_t kMostBatches = 64;

class PathSearch {
 public:
  PathSearch(const PathBounds& path, const Problem& problem, const Settings& settings,
             const PathSearchOptions& options)
      : options_(options),
        course_settings_(limits_of(settings)),
        course_(problem, course_settings_, options.progress),
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
    course_.announce();
    round_.begin(course_.deadline());
    open_.push_back(parts_.whole());
    while (!open_.empty() && !course_.must_stop()) decide_round();
    result_.stopped_by = course_.stopped_by();
    if (result_.stopped_by && !open_.empty()) result_.stopped_at = open_.back().piece;
    for (const PathPart& part : open_) leave_open(part);
    result_.trees = parts_.take_trees();
    result_.statistics.boxes = course_.boxes();
    result_.statistics.seconds = course_.seconds();
    course_.tell_end();
    return std::move(result_);
  }

 private:
  static BoxSearchSettings limits_of(const Settings& settings) {
    BoxSearchSettings limits;
    limits.max_boxes = settings.max_boxes;
    limits.time_limit = settings.time_limit;
    limits.interrupt = settings.interrupt;
    return limits;
  }

  void leave_open(const PathPart& part) {
    const std::size_t end = parts_.end_of(part);
    std::fill(result_.certified.begin() + std::ptrdiff_t(part.piece),
              result_.certified.begin() + std::ptrdiff_t(end), false);
  }

  void decide_round() {
    load_round();
    if (round_.size() == 0) return course_.note_lack_of_memory();
    if (!round_.decide(threshold_)) course_.note_lack_of_memory();
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
    course_.tell_progress(open_.size());
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
        course_.count(1);
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
    course_.leave_open({part.id, parts_.depth_of(part), {}}, rule);
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

  const PathSearchOptions& options_;
  const BoxSearchSettings course_settings_;
  BoxCourse course_;
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
