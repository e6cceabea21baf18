// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>

#include "codegen/question/condition/condition_proofs.hpp"

namespace regulus {
namespace {

using Box = BoxJudges::Box;

/// The boxes that are split in a round, whatever the number of threads: a part of those that are
/// open, so that few of them are split in vain, within these bounds.
constexpr std::size_t kPartOfOpen = 8, kFewestParents = 32, kMostParents = 1024;
/// If no bound is known after so many boxes, a singular pose is likely, or one that is nearly so.
constexpr std::uint64_t kBoxesBeforeDoubt = 1024;
/// Seconds between two saves: a tenth of the time so far, within these bounds.
constexpr double kSoonestSave = 0.25, kLatestSave = 10;
/// Saving takes at most this part of the time.
constexpr double kPartForSaving = 0.05;

class ConditionSearch {
 public:
  ConditionSearch(const ConditionQuestion& question, const ConditionSettings& settings,
                  Observer* progress)
      : problem_(question.problem),
        settings_(settings),
        progress_(progress),
        judges_(question, settings.threads, 2 * kMostParents,
                {settings.workers, settings.boxes_before_workers, settings.time_limit,
                 settings.interrupt}) {
    for (const Interval& range : problem_.outer) ranges_.push_back(width_ru(range));
  }

  ConditionResult run() {
    announce();
    if (settings_.from != nullptr)
      result_.is_continued = continue_from(*settings_.from);
    else
      decide_root();
    if (result_.is_continued)
      search();
    else
      open_.push(root());
    finish();
    return std::move(result_);
  }

 private:
  struct OpenBox {
    BoxId id;
    double upper;
    Box box;
    std::vector<double> impact;
    bool is_undefined = false;

    /// The largest bound first; among equal ones the first that was made.
    friend bool operator<(const OpenBox& a, const OpenBox& b) noexcept {
      return a.upper < b.upper || (a.upper == b.upper && a.id > b.id);
    }
  };
  struct OpenBoxes : std::priority_queue<OpenBox> {
    [[nodiscard]] const std::vector<OpenBox>& in_any_order() const { return c; }
  };
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] OpenBox root() const { return {0, kInfinity, problem_.outer, {}}; }

  void decide_root() {
    begin_round();
    add_child(root());
    finish_round();
  }

  void search() {
    while (!must_stop()) {
      begin_round();
      const std::size_t children =
          2 * std::clamp(open_.size() / kPartOfOpen, kFewestParents, kMostParents);
      while (!open_.empty() && children_.size() < children && !is_settled()) split_largest();
      finish_round();
      save_now_and_then();
    }
    save();
  }

  void announce() {
    if (progress_ == nullptr) return;
    Settings settings;
    settings.time_limit = settings_.time_limit;
    settings.workers = settings_.workers;
    progress_->on_start(problem_, settings);
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  [[nodiscard]] Statistics statistics() const {
    Statistics statistics;
    statistics.boxes = result_.boxes;
    statistics.seconds = seconds();
    return statistics;
  }
  [[nodiscard]] double attained() const {
    return result_.attained ? result_.attained->shown.condition : 0;
  }
  /// κ is below that everywhere.
  [[nodiscard]] double proved() const { return std::min(proved_by_boxes(), known_); }
  [[nodiscard]] double proved_by_boxes() const {
    return open_.empty() ? settled_ : std::max(settled_, open_.top().upper);
  }
  /// Returns true if a box with this bound need not be split.
  [[nodiscard]] bool is_low(double upper) const {
    upper = std::min(upper, known_);
    if (settings_.limit) return upper <= settings_.limit->lo;
    return std::isfinite(upper) && upper - attained() <= settings_.gap * upper;
  }
  [[nodiscard]] bool is_settled() const { return open_.empty() || is_low(open_.top().upper); }

  void stop(Reason reason) { result_.reason = reason; }

  [[nodiscard]] bool must_stop() {
    if (attained() == kInfinity || result_.is_singular) return true;
    if (settings_.limit && attained() >= settings_.limit->hi) return true;
    if (is_settled() || (!is_low(settled_) && open_.top().upper <= settled_)) return true;
    if (is_disturbed()) return true;
    if (result_.boxes >= settings_.max_boxes) return stop(Reason::kBoxBudget), true;
    if (is_late()) return true;
    if (result_.boxes >= kBoxesBeforeDoubt && proved() == kInfinity) ask();
    return result_.is_singular || is_settled();
  }

  [[nodiscard]] bool is_disturbed() {
    if (is_out_of_memory_) return stop(Reason::kMemory), true;
    if (settings_.interrupt != nullptr && *settings_.interrupt)
      return stop(Reason::kInterrupted), true;
    return false;
  }
  [[nodiscard]] bool is_late() {
    if (seconds() >= settings_.time_limit) return stop(Reason::kTimeBudget), true;
    return false;
  }

  /// A later run asks again if there was no answer: it may have more time.
  void ask() {
    if (has_asked_ || !settings_.ask || result_.reason == Reason::kInterrupted) return;
    has_asked_ = true;
    const ConditionHint hint = settings_.ask(settings_.time_limit - seconds());
    result_.is_singular = hint.is_singular;
    known_ = hint.upper;
    if (hint.is_singular || hint.upper < kInfinity) state_.was_told = true;
  }

  void begin_round() { children_.clear(), boxes_.clear(); }

  void split_largest() {
    OpenBox parent = open_.top();
    open_.pop();
    const std::optional<std::size_t> variable = choose(parent);
    if (!variable) return give_up(parent);
    const BoxId lower = next_id_;
    const Halves halves = split(parent.id, parent.box, *variable);
    Box upper = parent.box;
    parent.box[*variable] = halves.left;
    upper[*variable] = halves.right;
    add_child({lower, parent.upper, std::move(parent.box), {}});
    add_child({lower + 1, parent.upper, std::move(upper), {}});
  }

  Halves split(BoxId id, const Box& box, std::size_t variable) {
    const Halves halves = *bisect(box[variable]);
    if (progress_ != nullptr)
      progress_->on_split({id, 0, box},
                          {id, static_cast<std::uint32_t>(variable), halves.left.hi, next_id_});
    if (settings_.save) state_.add_split(id, variable);
    next_id_ += 2;
    return halves;
  }

  void add_child(OpenBox child) {
    boxes_.push_back(child.box);
    children_.push_back(std::move(child));
  }

  /// Returns the variable with the greatest impact, or else with the widest part of its range.
  [[nodiscard]] std::optional<std::size_t> choose(const OpenBox& open) const {
    std::optional<std::size_t> best;
    double most = -1, most_width = 0;
    for (std::size_t v = 0; v < open.box.size(); ++v) {
      const double width = width_ru(open.box[v]) / ranges_[v];
      if (!(width > settings_.min_relative_width) || !bisect(open.box[v])) continue;
      const double impact =
          open.impact.empty() || std::isnan(open.impact[v]) ? width : open.impact[v];
      if (impact > most || (impact == most && width > most_width))
        best = v, most = impact, most_width = width;
    }
    return best;
  }

  void finish_round() {
    findings_.assign(boxes_.size(), {});
    result_.boxes += boxes_.size();
    if (!judges_.judge(boxes_, findings_, attained())) is_out_of_memory_ = true;
    for (std::size_t i = 0; i < boxes_.size(); ++i) conclude(i);
    if (progress_ != nullptr) progress_->on_progress(statistics(), open_.size());
  }

  void conclude(std::size_t i) {
    BoxFinding& finding = findings_[i];
    OpenBox& child = children_[i];
    if (finding.is_outside) return exclude(child);
    attain(child.id, finding.attained);
    child.upper = std::min(child.upper, finding.bound.upper);
    child.impact = std::move(finding.bound.impact);
    child.is_undefined = finding.is_undefined;
    if (is_low(child.upper))
      settle(child);
    else
      open_.push(std::move(child));
  }

  void attain(BoxId box, std::optional<ConditionWitness>& witness) {
    if (!witness || !(witness->shown.condition > attained())) return;
    result_.attained = std::move(witness);
    state_.attained = box;
  }

  void exclude(const OpenBox& box) {
    if (settings_.save) state_.add_outside(box.id);
    leave(box, Rule::kOutside);
  }
  /// The box keeps its bound.
  void settle(const OpenBox& box) {
    is_empty_ = false;
    settled_ = std::max(settled_, box.upper);
    if (settings_.save) state_.add_settled(box.id, box.upper);
    leave(box, Rule::kSecondOrder);
  }
  /// The box cannot be split.
  void give_up(const OpenBox& box) {
    if (box.upper > settled_) stop(box.is_undefined ? Reason::kUndefined : Reason::kWidth);
    settle(box);
  }
  void leave(const OpenBox& box, Rule rule) {
    if (progress_ != nullptr) progress_->on_leaf({box.id, 0, box.box}, rule, {});
  }

  /// Returns false if it had to stop before.
  bool continue_from(const ConditionState& from) {
    const ConditionTree tree(from, problem_.outer);
    result_.boxes = tree.size();
    auto proved =
        prove_again(tree, from.attained, judges_, [this] { return is_disturbed() || is_late(); });
    if (!proved && !is_disturbed() && !is_late()) {
      is_out_of_memory_ = true;
      stop(Reason::kMemory);
    }
    if (!proved) return false;
    if (from.attained) attain(*from.attained, proved->attained);
    if (from.was_told) ask();
    state_.was_told = from.was_told;
    repeat(tree, proved->leaves);
    saved_ = seconds();
    return true;
  }

  /// Tells of the splits and leaves in their order.
  void repeat(const ConditionTree& tree, std::vector<ProvedLeaf>& proved) {
    std::size_t leaf = 0;
    for (const ConditionTree::Step& step : tree.steps())
      if (step.variable)
        split(step.box, tree.box(step.box), *step.variable);
      else
        conclude_again({step.box, kInfinity, tree.box(step.box), {}}, proved[leaf++], true);
    for (; leaf < proved.size(); ++leaf) {
      const BoxId id = tree.leaves()[leaf].box;
      conclude_again({id, kInfinity, tree.box(id), {}}, proved[leaf], false);
    }
    if (progress_ != nullptr) progress_->on_progress(statistics(), open_.size());
  }

  /// With another gap, a box may be split that was not split any more.
  void conclude_again(OpenBox box, ProvedLeaf& proved, bool was_settled) {
    if (proved.is_outside) return exclude(box);
    box.upper = proved.upper;
    box.impact = std::move(proved.impact);
    box.is_undefined = proved.is_undefined;
    if (was_settled && is_low(box.upper)) return settle(box);
    if (was_settled && !choose(box)) return give_up(box);
    open_.push(std::move(box));
  }

  void save_now_and_then() {
    const double now = seconds();
    const double pause = std::max(std::clamp(now / 10, kSoonestSave, kLatestSave),
                                  seconds_of_save_ / kPartForSaving);
    if (now - saved_ >= pause) save();
  }

  void save() {
    if (!settings_.save || is_out_of_memory_) return;
    const double start = seconds();
    std::vector<const OpenBox*> open;
    for (const OpenBox& box : open_.in_any_order()) open.push_back(&box);
    std::ranges::sort(open, {}, &OpenBox::id);
    state_.open.clear();
    for (const OpenBox* box : open) state_.add_open(box->id, box->upper);
    settings_.save(state_);
    saved_ = seconds();
    seconds_of_save_ = saved_ - start;
  }

  void finish() {
    if (attained() == kInfinity) result_.is_singular = true;
    if (!result_.is_singular && proved() == kInfinity) ask();
    result_.proved = result_.is_singular || is_out_of_memory_ ? kInfinity : proved();
    result_.is_by_hint = known_ < proved_by_boxes();
    result_.is_empty = open_.empty() && is_empty_;
    const bool is_exceeded = settings_.limit && attained() >= settings_.limit->hi;
    result_.is_closed = !result_.is_empty && (is_exceeded || is_low(result_.proved));
    result_.seconds = seconds();
    if (progress_ == nullptr) return;
    for (; !open_.empty(); open_.pop()) leave(open_.top(), Rule::kSecondOrder);
    Result result;
    result.statistics = statistics();
    progress_->on_finish(result);
  }

  const Problem& problem_;
  const ConditionSettings& settings_;
  Observer* progress_;
  BoxJudges judges_;
  std::vector<double> ranges_;
  OpenBoxes open_;
  std::vector<OpenBox> children_;  ///< of the round, in the order of their numbers
  std::vector<Box> boxes_;         ///< theirs
  std::vector<BoxFinding> findings_;
  BoxId next_id_ = 1;
  double known_ = kInfinity;  ///< κ is below that everywhere
  double settled_ = 0;        ///< the largest bound of all boxes that are not split any more
  bool is_empty_ = true, has_asked_ = false, is_out_of_memory_ = false;
  ConditionState state_;  ///< without its open boxes
  double saved_ = 0, seconds_of_save_ = 0;
  const Clock::time_point start_ = Clock::now();
  ConditionResult result_;
};

}  // namespace

ConditionResult search_condition(const ConditionQuestion& question,
                                 const ConditionSettings& settings, Observer* progress) {
  return ConditionSearch(question, settings, progress).run();
}

}  // namespace regulus
