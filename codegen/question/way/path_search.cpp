// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_search.hpp"

#include <algorithm>
#include <limits>

#include "codegen/question/way/regularity_judge.hpp"
#include "runtime/search/box_search.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kBoxesOfRound = 64 * kLanes;

class PathSearch {
 public:
  PathSearch(const PathBounds& path, const Problem& problem, const Settings& settings,
             const PathSearchOptions& options)
      : options_(options),
        course_settings_(limits_of(settings)),
        course_(problem, course_settings_, options.progress),
        judges_({problem, settings}, settings.threads, kBoxesOfRound,
                {settings.workers, options.boxes_before_workers, settings.time_limit,
                 settings.interrupt}),
        claims_(problem, options.reach),
        parts_(path, problem, {options.added, options.uncertain}, options.wants_trees),
        steps_(options.checkpoint, problem.kernel->motion_variables),
        box_(problem.outer),
        boxes_(path.pieces()),
        blocked_(path.pieces(), false) {
    result_.certified.assign(path.pieces(), true);
    result_.leaves.resize(path.pieces());
  }

  PathSearchResult run() {
    course_.announce();
    open_.push_back(parts_.whole());
    while (!open_.empty() && !must_stop()) decide_round();
    steps_.save();
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

  /// The limit of boxes does not cut what an earlier run has done.
  [[nodiscard]] bool must_stop() {
    return steps_.is_repeating() ? course_.must_pause() : course_.must_stop();
  }

  void leave_open(const PathPart& part) {
    const std::size_t end = parts_.end_of(part);
    std::fill(result_.certified.begin() + std::ptrdiff_t(part.piece),
              result_.certified.begin() + std::ptrdiff_t(end), false);
  }

  void decide_round() {
    take_parts();
    if (taken_.empty()) return;
    found_.assign(taken_.size(), {});
    decided_.assign(taken_.size(), true);
    const bool is_told = steps_.is_repeating() && steps_.take(found_);
    if (is_told)
      judge_told();
    else
      judge_all();
    if (std::ranges::find(decided_, false) != decided_.end()) steps_.end(is_told);
    conclude();
  }

  void take_parts() {
    taken_.clear();
    while (!open_.empty() && taken_.size() < kBoxesOfRound) {
      PathPart part = std::move(open_.back());
      open_.pop_back();
      if ((part.pieces == 1 && blocked_[part.piece]) || is_skipped(part)) continue;
      taken_.push_back(std::move(part));
    }
    course_.count(taken_.size());
  }

  void judge_all() {
    const auto is_judged = [](std::size_t) { return true; };
    judge(is_judged, threshold_.value(),
          [this](std::size_t at, const PathStep& step) { found_[at] = step; });
    for (const RegularityFinding& finding : findings_)
      for (const TrialOutcome& trial : finding.trials) threshold_.learn(trial);
  }

  /// A part that is not certified again has the step that it needs now. A test that was of use is
  /// tried, whatever the search had learned when it came to the part.
  void judge_told() {
    constexpr double kEveryTest = std::numeric_limits<double>::max();
    threshold_ = AdaptiveThreshold(steps_.earlier_limit());
    bool is_same = true;
    const auto is_judged = [this](std::size_t at) {
      return found_[at].kind == PathStep::Kind::kCertified;
    };
    judge(is_judged, kEveryTest, [&](std::size_t at, const PathStep& now) {
      const bool is_certified = now.kind == PathStep::Kind::kCertified;
      if (is_certified && (now.rule == Rule::kOutside) == (found_[at].rule == Rule::kOutside))
        return;
      found_[at] = now;
      is_same = false;
    });
    if (!is_same) steps_.stop_repeating();
  }

  /// Judges those of the parts that were taken: note(at, step).
  template <class IsJudged, class Note>
  void judge(const IsJudged& is_judged, double threshold, const Note& note) {
    judged_.clear();
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      decided_[i] = !is_judged(i);
      if (decided_[i]) continue;
      parts_.load_box(taken_[i], box_);
      judged_.push_back(box_);
      judged_.back().emplace_back(taken_[i].depth);
    }
    findings_.assign(judged_.size(), {});
    if (!judged_.empty() && !judges_.judge(judged_, findings_, threshold))
      course_.note_lack_of_memory();
    for (std::size_t i = 0, n = 0; i < taken_.size(); ++i) {
      if (decided_[i]) continue;
      const RegularityFinding& finding = findings_[n++];
      decided_[i] = finding.is_decided;
      if (finding.is_decided) note(i, finding.step);
    }
  }

  void conclude() {
    std::vector<PathPart> halves;
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (decided_[i])
        settle(taken_[i], found_[i], halves);
      else
        halves.push_back(std::move(taken_[i]));
    }
    steps_.add(found_, threshold_.value());
    open_.insert(open_.end(), std::make_move_iterator(halves.rbegin()),
                 std::make_move_iterator(halves.rend()));
    result_.statistics.max_frontier =
        std::max<std::uint64_t>(result_.statistics.max_frontier, open_.size());
    course_.tell_progress(open_.size());
  }

  [[nodiscard]] bool is_skipped(const PathPart& part) const {
    if (options_.skipped == nullptr) return false;
    const std::size_t end = parts_.end_of(part);
    const auto first = options_.skipped->begin();
    return std::all_of(first + std::ptrdiff_t(part.piece), first + std::ptrdiff_t(end),
                       [](bool skipped) { return skipped; });
  }

  void settle(PathPart& part, const PathStep& step, std::vector<PathPart>& halves) {
    if (step.kind == PathStep::Kind::kCertified) return certify(part, step.rule);
    if (part.pieces > 1) return parts_.split_group(part, halves);
    const bool is_lost = step.kind == PathStep::Kind::kLost;
    if (is_lost || ++boxes_[part.piece] > options_.most_boxes) return block(part);
    if (!parts_.split(part, step.variable, halves)) block(part);
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
  BoxJudges<RegularityJudge> judges_;
  AdaptiveThreshold threshold_;
  LeafClaims claims_;
  PathParts parts_;
  PathSteps steps_;
  std::vector<Interval> box_;
  std::vector<std::uint32_t> boxes_;  ///< evaluated in each piece
  std::vector<bool> blocked_;
  std::vector<PathPart> open_, taken_;
  std::vector<std::vector<Interval>> judged_;  ///< boxes of a round
  std::vector<RegularityFinding> findings_;    ///< about them
  std::vector<PathStep> found_;                ///< about those that were taken
  std::vector<bool> decided_;                  ///< the same: false: not judged, and not told either
  PathSearchResult result_;
};

}  // namespace

PathSearchResult search_path(const PathBounds& path, const Problem& problem,
                             const Settings& settings, const PathSearchOptions& options) {
  return PathSearch(path, problem, settings, options).run();
}

}  // namespace regulus::detail
