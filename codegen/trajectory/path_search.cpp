// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/trajectory/path_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "runtime/certificate/writer.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/search/leaf_claims.hpp"
#include "runtime/search/round.hpp"

namespace regulus::inline trajectory {
namespace {

using Clock = std::chrono::steady_clock;

/// A piece that needs more is left to a search of its own, which can also find a singularity.
constexpr std::uint32_t kMostBoxesOfAPiece = 2048;
constexpr double kShortestPart = 0x1p-24;
constexpr std::size_t kMostBatches = 64;

/// A part of the trajectory that is not decided yet.
struct Part {
  std::size_t piece = 0, pieces = 1;  ///< a group of pieces has neither number nor errors
  BoxId id = 0;
  std::uint32_t depth = 0;
  double begin = 0, end = 1;     ///< of s
  std::vector<Interval> errors;  ///< by moving parameter; empty: all
};

class PathSearch {
 public:
  PathSearch(const PathBounds& path, const Problem& problem, const Settings& settings,
             const PathSearchOptions& options)
      : path_(path),
        problem_(problem),
        settings_(settings),
        options_(options),
        structure_(find_row_structure(problem, settings)),
        round_(problem, settings, structure_),
        claims_(problem, options.reach),
        box_(problem.outer),
        boxes_(path.pieces()),
        next_id_(path.pieces(), 1),
        blocked_(path.pieces(), false) {
    result_.certified.assign(path.pieces(), true);
    result_.leaves.resize(path.pieces());
    if (options.wants_trees) result_.trees.resize(path.pieces());
    number_errors();
  }

  PathSearchResult run() {
    round_.begin(deadline());
    std::size_t all = 1;
    while (all < path_.pieces()) all *= 2;
    open_.push_back({0, all, 0, 0, 0, 1, {}});
    while (!open_.empty() && !must_stop()) decide_round();
    for (const Part& part : open_) leave_open(part);
    result_.statistics.seconds = seconds();
    return std::move(result_);
  }

 private:
  /// In a certificate, variables are s, the uncertain quantities, and the control errors.
  void number_errors() {
    std::size_t next = 1 + options_.uncertain;
    for (const Interval& error : path_.errors()) error_number_.push_back(error.hi > 0 ? next++ : 0);
  }

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

  void leave_open(const Part& part) {
    const std::size_t end = std::min(part.piece + part.pieces, path_.pieces());
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
    std::vector<Part> taken = std::move(taken_);
    taken_.clear();
    std::vector<Part> halves;
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
        Part part = std::move(open_.back());
        open_.pop_back();
        if (part.pieces == 1 && blocked_[part.piece]) continue;
        load_box(part);
        batch->add({part.id, part.depth, box_});
        taken_.push_back(std::move(part));
        ++result_.statistics.boxes;
      }
    }
  }

  /// A part lies in the ranges of the problem as well as in its own hull.
  void load_box(const Part& part) {
    for (std::size_t m = 0; m < path_.moving().size(); ++m) {
      const Interval poses = commanded(part, m) + error_of(part, m);
      box_[m] = intersect(poses, problem_.outer[m]).value_or(problem_.outer[m]);
    }
  }

  [[nodiscard]] Interval commanded(const Part& part, std::size_t m) const {
    return part.pieces > 1 ? path_.over_pieces(part.piece, part.pieces, m)
                           : path_.over(part.piece, m, part.begin, part.end);
  }

  [[nodiscard]] Interval error_of(const Part& part, std::size_t m) const {
    return part.errors.empty() ? path_.errors()[m] : part.errors[m];
  }

  void settle(Part& part, const Decision& decision, std::vector<Part>& halves) {
    const bool is_leaf = decision.kind == Decision::Kind::kLeaf;
    if (is_leaf && decision.rule != Rule::kBlocked) return certify(part, decision.rule);
    if (part.pieces > 1) return split_group(part, halves);
    if (is_leaf || ++boxes_[part.piece] > kMostBoxesOfAPiece) return block(part);
    split(part, decision.variable, halves);
  }

  void certify(const Part& part, Rule rule) {
    ++result_.statistics.leaves[static_cast<std::size_t>(rule)];
    const std::size_t end = std::min(part.piece + part.pieces, path_.pieces());
    const Claim claim = claim_of_leaf(part, rule);
    for (std::size_t k = part.piece; k < end; ++k) {
      result_.leaves[k].within |= claim == Claim::kFree;
      result_.leaves[k].outside |= claim == Claim::kOutside;
      result_.leaves[k].out_of_reach |= claim == Claim::kUnreachable;
    }
    if (!options_.wants_trees) return;
    for (std::size_t k = part.piece; k < end; ++k) {
      result_.trees[k].lines += fmt::format("l {} {}\n", part.id, certificate_word(rule));
      ++result_.trees[k].leaves;
    }
  }

  [[nodiscard]] Claim claim_of_leaf(const Part& part, Rule rule) {
    if (rule != Rule::kOutside) return Claim::kFree;
    load_box(part);
    return claims_.of(box_, rule);
  }

  void block(const Part& part) {
    blocked_[part.piece] = true;
    result_.certified[part.piece] = false;
  }

  static void split_group(const Part& part, std::size_t pieces, std::vector<Part>& halves) {
    const std::size_t half = part.pieces / 2;
    halves.push_back({part.piece, half, 0, 0, 0, 1, {}});
    if (part.piece + half < pieces) halves.push_back({part.piece + half, half, 0, 0, 0, 1, {}});
  }
  void split_group(const Part& part, std::vector<Part>& halves) const {
    split_group(part, path_.pieces(), halves);
  }

  /// Splits what makes that pose parameter wide: the part of the path, or its control error.
  void split(Part& part, std::size_t variable, std::vector<Part>& halves) {
    const Interval path = commanded(part, variable), error = error_of(part, variable);
    const bool in_error = error.hi - error.lo > path.hi - path.lo;
    const auto parts = in_error ? bisect(error) : bisect(Interval(part.begin, part.end));
    if (!parts || (!in_error && part.end - part.begin < kShortestPart)) return block(part);
    Part first = part, second = std::move(part);
    if (in_error) {
      if (first.errors.empty()) {
        first.errors.assign(path_.errors().begin(), path_.errors().end());
        second.errors = first.errors;
      }
      first.errors[variable] = parts->left;
      second.errors[variable] = parts->right;
    } else {
      first.end = second.begin = parts->left.hi;
    }
    const std::size_t number = in_error ? error_number_[variable] : 0;
    BoxId& next = next_id_[first.piece];
    if (options_.wants_trees)
      result_.trees[first.piece].lines +=
          fmt::format("s {} {} {:a}\n", first.id, number, parts->left.hi);
    first.id = next++;
    second.id = next++;
    ++first.depth, ++second.depth;
    halves.push_back(std::move(first));
    halves.push_back(std::move(second));
  }

  const PathBounds& path_;
  const Problem& problem_;
  const Settings& settings_;
  const PathSearchOptions& options_;
  const Clock::time_point start_ = Clock::now();
  const RowStructure structure_;
  Round round_;
  AdaptiveThreshold threshold_;
  LeafClaims claims_;
  std::vector<Interval> box_;
  std::vector<std::uint32_t> boxes_;  ///< evaluated in each piece
  std::vector<BoxId> next_id_;
  std::vector<bool> blocked_;
  std::vector<std::size_t> error_number_;  ///< of a moving parameter's error in a certificate
  std::vector<Part> open_, taken_;
  PathSearchResult result_;
};

}  // namespace

PathSearchResult search_path(const PathBounds& path, const Problem& problem,
                             const Settings& settings, const PathSearchOptions& options) {
  return PathSearch(path, problem, settings, options).run();
}

}  // namespace regulus::trajectory
