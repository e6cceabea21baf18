// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/condition_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <queue>
#include <thread>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::inline bounding {
namespace {

using Box = std::vector<Interval>;

/// The boxes that are split in a round, whatever the number of threads.
constexpr std::size_t kParentsOfRound = 32;
/// If no bound is known after so many boxes, a singular pose is likely, or one that is nearly so.
constexpr std::uint64_t kBoxesBeforeDoubt = 1024;

/// The result for one box.
struct BoxFinding {
  bool is_outside = false, is_undefined = false;
  ConditionBound bound{};
  std::optional<ConditionWitness> attained{};
};

/// Decides boxes. Each thread has its own.
class BoxJudge {
 public:
  explicit BoxJudge(const ConditionQuestion& question)
      : problem_(question.problem),
        rows_(question.problem.kernel->rows),
        columns_(question.problem.kernel->columns),
        rotated_(question.problem, question.scaling),
        matrices_(rotated_.matrices()) {}

  /// `attained`: a smaller κ is of no use.
  void judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained) {
    rotated_.evaluate(boxes);
    std::vector<Box> points;
    std::vector<std::size_t> of;
    for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
      BoxFinding& finding = findings[lane];
      finding.is_outside = matrices_.is_outside(lane);
      if (finding.is_outside) continue;
      const std::optional<RotatedBox> rotated = rotated_.rotated(lane);
      finding.is_undefined = !rotated;
      if (rotated) finding.bound = bound_condition(*rotated);
      if (matrices_.is_inhabited(lane))
        keep(finding, matrices_.point(lane), matrices_.matrix_at_point(lane), attained);
      if (finding.bound.growth.empty() || !(finding.bound.upper > attained)) continue;
      points.push_back(corner(boxes[lane], matrices_.point(lane), finding.bound.growth));
      of.push_back(lane);
    }
    if (points.empty()) return;
    const auto matrices = matrices_.at(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (matrices[i]) keep(findings[of[i]], points[i], *matrices[i], attained);
  }

 private:
  /// Returns the corner of the box in whose direction κ grows.
  [[nodiscard]] Box corner(const Box& box, Box point, const std::vector<double>& growth) const {
    for (std::size_t v = 0; v < point.size(); ++v) {
      const std::optional<Interval>& inner = problem_.inner[v];
      if (!inner || growth[v] == 0 || std::isnan(growth[v])) continue;
      point[v] = std::clamp(growth[v] > 0 ? box[v].hi : box[v].lo, inner->lo, inner->hi);
    }
    return point;
  }

  void keep(BoxFinding& finding, const Box& point, std::span<const Interval> A, double attained) {
    StretchedVectors shown = attained_condition(A, rows_, columns_);
    const double known = finding.attained ? finding.attained->shown.condition : attained;
    if (shown.condition > known) finding.attained.emplace(ConditionWitness{point, shown});
  }

  const Problem& problem_;
  const std::size_t rows_, columns_;
  RotatedBoxes rotated_;
  BoxMatrices& matrices_;
};

class ConditionSearch {
 public:
  ConditionSearch(const ConditionQuestion& question, const ConditionSettings& settings,
                  Observer* progress)
      : problem_(question.problem), settings_(settings), progress_(progress) {
    const unsigned most = unsigned(2 * kParentsOfRound / kLanes);
    for (unsigned t = 0; t < std::clamp(settings.threads, 1U, most); ++t)
      judges_.push_back(std::make_unique<BoxJudge>(question));
    for (const Interval& range : problem_.outer) ranges_.push_back(width_ru(range));
  }

  ConditionResult run() {
    announce();
    begin_round();
    add_child({0, kInfinity, problem_.outer, {}});
    finish_round();
    while (!must_stop()) {
      begin_round();
      while (!open_.empty() && children_.size() < 2 * kParentsOfRound && !is_settled())
        split_largest();
      finish_round();
    }
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
  using Clock = std::chrono::steady_clock;

  void announce() {
    if (progress_ == nullptr) return;
    Settings settings;
    settings.time_limit = settings_.time_limit;
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
    if (is_out_of_memory_) return stop(Reason::kMemory), true;
    if (settings_.interrupt != nullptr && *settings_.interrupt)
      return stop(Reason::kInterrupted), true;
    if (result_.boxes >= settings_.max_boxes) return stop(Reason::kBoxBudget), true;
    if (seconds() >= settings_.time_limit) return stop(Reason::kTimeBudget), true;
    if (result_.boxes >= kBoxesBeforeDoubt && proved() == kInfinity) ask();
    return result_.is_singular || is_settled();
  }

  void ask() {
    if (has_asked_ || !settings_.ask || result_.reason == Reason::kInterrupted) return;
    has_asked_ = true;
    const ConditionHint hint = settings_.ask(settings_.time_limit - seconds());
    result_.is_singular = hint.is_singular;
    known_ = hint.upper;
  }

  void begin_round() { children_.clear(), boxes_.clear(); }

  /// A box that cannot be split keeps its bound.
  void split_largest() {
    OpenBox parent = open_.top();
    open_.pop();
    const std::optional<std::size_t> variable = choose(parent);
    if (!variable) {
      if (parent.upper > settled_) stop(parent.is_undefined ? Reason::kUndefined : Reason::kWidth);
      return settle(parent);
    }
    const Halves halves = *bisect(parent.box[*variable]);
    if (progress_ != nullptr)
      progress_->on_split(
          {parent.id, 0, parent.box},
          {parent.id, static_cast<std::uint32_t>(*variable), halves.left.hi, next_id_});
    Box upper = parent.box;
    parent.box[*variable] = halves.left;
    upper[*variable] = halves.right;
    add_child({next_id_, parent.upper, std::move(parent.box), {}});
    add_child({next_id_ + 1, parent.upper, std::move(upper), {}});
    next_id_ += 2;
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
    judge_round();
    for (std::size_t i = 0; i < boxes_.size(); ++i) conclude(i);
    if (progress_ != nullptr) progress_->on_progress(statistics(), open_.size());
  }

  void judge_round() {
    std::atomic<std::size_t> next = 0;
    const double known = attained();
    const auto work = [&](BoxJudge& judge) noexcept {
      const FloatingPointScope nearest(FloatingPointRounding::kNearest);
      for (std::size_t at; (at = kLanes * next++) < boxes_.size();) {
        const std::size_t count = std::min(kLanes, boxes_.size() - at);
        try {
          judge.judge(std::span<const Box>(boxes_).subspan(at, count),
                      std::span(findings_).subspan(at, count), known);
        } catch (const std::bad_alloc&) {
          is_out_of_memory_ = true;
        }
      }
    };
    const std::size_t batches = (boxes_.size() + kLanes - 1) / kLanes;
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(judges_.size(), batches); ++t)
      others.emplace_back([&work, this, t] { work(*judges_[t]); });
    work(*judges_.front());
  }

  void conclude(std::size_t i) {
    BoxFinding& finding = findings_[i];
    OpenBox& child = children_[i];
    if (finding.is_outside) return leave(child, Rule::kOutside);
    is_empty_ = false;
    if (finding.attained && finding.attained->shown.condition > attained())
      result_.attained = std::move(finding.attained);
    child.upper = std::min(child.upper, finding.bound.upper);
    child.impact = std::move(finding.bound.impact);
    child.is_undefined = finding.is_undefined;
    if (is_low(child.upper))
      settle(child);
    else
      open_.push(std::move(child));
  }

  /// The box keeps its bound.
  void settle(const OpenBox& box) {
    settled_ = std::max(settled_, box.upper);
    leave(box, Rule::kSecondOrder);
  }
  void leave(const OpenBox& box, Rule rule) {
    if (progress_ != nullptr) progress_->on_leaf({box.id, 0, box.box}, rule, {});
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
  std::vector<std::unique_ptr<BoxJudge>> judges_;
  std::vector<double> ranges_;
  std::priority_queue<OpenBox> open_;
  std::vector<OpenBox> children_;  ///< of the round, in the order of their numbers
  std::vector<Box> boxes_;         ///< theirs
  std::vector<BoxFinding> findings_;
  BoxId next_id_ = 1;
  double known_ = kInfinity;  ///< κ is below that everywhere
  double settled_ = 0;        ///< the largest bound of all boxes that are not split any more
  bool is_empty_ = true, has_asked_ = false;
  std::atomic<bool> is_out_of_memory_ = false;
  const Clock::time_point start_ = Clock::now();
  ConditionResult result_;
};

}  // namespace

ConditionResult search_condition(const ConditionQuestion& question,
                                 const ConditionSettings& settings, Observer* progress) {
  return ConditionSearch(question, settings, progress).run();
}

}  // namespace regulus::bounding
