// SPDX-License-Identifier: Apache-2.0
// Algorithm 1 on up to eight boxes at a time, with the constraints of Table II.
//
// A box is left for one of three reasons: a constraint excludes it, a test certifies it, or it
// cannot be decided and is not to be split any more. The last kind rules out NO SINGULARITY; the
// search then goes on for a while, widest boxes first, since SINGULARITY may still be shown.
// An exhaustive search goes through all boxes, and looks for a singularity inside each that
// remains.
#include "regulus/search/solver.hpp"

#include <algorithm>
#include <bit>
#include <chrono>

#include "regulus/kernel/rounding_scope.hpp"
#include "regulus/search/batch.hpp"
#include "regulus/search/bisector.hpp"
#include "regulus/search/box_witness.hpp"
#include "regulus/search/frontier.hpp"
#include "regulus/search/row_structure.hpp"
#include "regulus/search/tests.hpp"
#include "regulus/search/witness_search.hpp"

namespace regulus {
namespace {

using Clock = std::chrono::steady_clock;

/// How many splits lie between two checks that the uncertainty leaves the box a chance.
constexpr std::uint32_t kStallCheck = 12;

/// How many splits lie between two boxes on which every test is tried: one that stopped paying
/// elsewhere may be the only one that can certify a box, however small.
constexpr std::uint32_t kEveryTest = 4;

/// Witness searches that start from boxes that could not be decided.
constexpr std::uint64_t kMaxDescentsFromBlocked = 16;

class Search {
 public:
  Search(const Problem& problem, const Settings& settings, Observer* observer)
      : problem_(problem),
        settings_(settings),
        observer_(observer != nullptr ? *observer : silent_),
        structure_(find_row_structure(problem, settings)),
        batch_(problem, settings, structure_),
        center_(problem, settings, structure_),
        tests_(make_tests(problem, settings, structure_)),
        bisector_(problem, settings),
        witness_(problem, settings),
        box_witness_(problem, settings),
        frontier_(problem.kernel->variables),
        current_(kLanes * problem.kernel->variables),
        half_(problem.kernel->variables),
        blocking_(problem.kernel->variables),
        filter_boxes_(settings.filters.size()),
        keeps_uncertainty_whole_(problem.kernel->variables > problem.kernel->motion_variables &&
                                 settings.uncertainty == Uncertainty::kElements) {}

  Result run(std::span<const OpenBox> open, BoxId next_id);

 private:
  void loop() noexcept;
  [[nodiscard]] bool must_stop() noexcept;
  void stop(Reason reason) noexcept;
  void stop_at_open_box(Reason reason) noexcept;

  void load_batch() noexcept;
  void decide_batch() noexcept;
  [[nodiscard]] LaneMask leave_outside(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_certified(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_small(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask at_minimum_width(LaneMask lanes) noexcept;
  void count_filter(std::size_t test, LaneMask certified) noexcept;
  [[nodiscard]] std::size_t vector_order(Rule rule) const noexcept;
  void leave(std::size_t lane, Rule rule, Proof proof) noexcept;
  void leave_with_witness(std::size_t lane) noexcept;
  void leave_undecided(std::size_t lane, Reason reason) noexcept;
  void report_open() noexcept;
  void look_for_witness(LaneMask undecided) noexcept;
  void split_or_block(std::size_t lane) noexcept;
  void split_or_look_inside(std::size_t lane) noexcept;
  void split(std::size_t lane, std::size_t variable) noexcept;
  void block(std::size_t lane, Reason reason) noexcept;
  void load_center(std::size_t lane, std::size_t thin_variables, std::size_t center) noexcept;
  [[nodiscard]] Reason reason_at_minimum_width(std::size_t lane) noexcept;
  [[nodiscard]] bool undefined_at_middle(std::size_t lane) noexcept;
  [[nodiscard]] bool certified_by_determinant(std::size_t lane) noexcept;
  [[nodiscard]] bool certified_by_oracle(std::size_t lane) noexcept;
  [[nodiscard]] LaneMask hopeless_under_uncertainty(LaneMask lanes) noexcept;
  [[nodiscard]] Result conclude();

  [[nodiscard]] std::span<Interval> box_of(std::size_t lane) noexcept {
    const std::size_t variables = problem_.kernel->variables;
    return {current_.data() + lane * variables, variables};
  }
  [[nodiscard]] bool looking_for_witness() const noexcept {
    return !settings_.exhaustive && !witness_.found();
  }

  Observer silent_;
  const Problem& problem_;
  const Settings& settings_;
  Observer& observer_;
  const RowStructure structure_;
  Batch batch_, center_;
  TestSequence tests_;
  Bisector bisector_;
  WitnessSearch witness_;
  BoxWitness box_witness_;
  std::optional<Witness> first_witness_;  ///< of an exhaustive search
  Reason first_witness_reason_ = Reason::kOppositeSigns;
  Frontier frontier_;
  std::vector<Interval> current_, half_, blocking_;
  std::vector<std::uint64_t> filter_boxes_;
  OpenBox open_[kLanes];
  LaneMask hopeless_ = 0;  ///< of the batch
  BoxId next_id_ = 1;
  const bool keeps_uncertainty_whole_;
  bool blocked_ = false;
  bool stopped_ = false;
  bool exhausted_ = false;  ///< stopped by a budget or from outside, not by a verdict
  std::optional<Reason> stopped_by_;
  Reason reason_ = Reason::kAllBoxesCertified;
  std::uint64_t boxes_when_blocked_ = 0;
  std::uint64_t next_descent_ = 1;
  Statistics statistics_;
  Clock::time_point start_ = Clock::now();
};

bool is_point(std::span<const Interval> box) noexcept {
  return std::all_of(box.begin(), box.end(), [](const Interval& x) { return x.lo == x.hi; });
}

bool cannot_be_halved(std::span<const Interval> box) noexcept {
  return std::none_of(box.begin(), box.end(), [](const Interval& x) { return bisect(x); });
}

double seconds_since(Clock::time_point start) noexcept {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Result Search::run(std::span<const OpenBox> open, BoxId next_id) {
  next_id_ = next_id;
  observer_.on_start(problem_, settings_);
  batch_.clear();
  batch_.load(0, problem_.outer);
  batch_.seal(1);
  batch_.learn_from_root();
  for (std::size_t k = open.size(); k-- > 0;)
    if (!frontier_.push_top(open[k], bisector_.approx_relative_width(open[k].box)))
      stop_at_open_box(Reason::kMemory);
  loop();
  if (exhausted_) report_open();
  Result result = conclude();
  observer_.on_finish(result);
  return result;
}

void Search::loop() noexcept {
  while (!frontier_.empty() && !stopped_) {
    if (must_stop()) return;
    load_batch();
    decide_batch();
    observer_.on_progress(statistics_, frontier_.size());
  }
}

bool Search::must_stop() noexcept {
  if (settings_.interrupt != nullptr && settings_.interrupt->load(std::memory_order_relaxed))
    stop_at_open_box(Reason::kInterrupted);
  else if (statistics_.boxes >= settings_.max_boxes)
    stop_at_open_box(Reason::kBoxBudget);
  else if (seconds_since(start_) >= settings_.time_limit)
    stop_at_open_box(Reason::kTimeBudget);
  else if (blocked_ && !settings_.exhaustive &&
           statistics_.boxes - boxes_when_blocked_ >= settings_.boxes_after_problem)
    stopped_ = true;
  return stopped_;
}

void Search::stop_at_open_box(Reason reason) noexcept {
  stopped_ = exhausted_ = true;
  stopped_by_ = reason;
  if (blocked_) return;
  reason_ = reason;
  if (frontier_.empty()) return;
  const OpenBox top = frontier_.top();
  std::copy(top.box.begin(), top.box.end(), blocking_.begin());
}

void Search::load_batch() noexcept {
  batch_.clear();
  std::size_t count = 0;
  while (count < settings_.batch && !frontier_.empty() && statistics_.boxes < settings_.max_boxes) {
    // Once NO SINGULARITY is out of reach, the widest boxes show most of what is left.
    const bool from_end = blocked_ && !settings_.exhaustive;
    const OpenBox next = from_end ? frontier_.end() : frontier_.top();
    std::copy(next.box.begin(), next.box.end(), box_of(count).begin());
    open_[count] = {next.id, next.depth, box_of(count)};
    batch_.load(count, open_[count].box);
    from_end ? frontier_.pop_end() : frontier_.pop();
    ++count;
    ++statistics_.boxes;
  }
  batch_.seal(count);
}

/// Steps 5–30 for each box of the batch. Undecided boxes are split last to first, so that the first
/// ends on top again.
void Search::decide_batch() noexcept {
  const LaneMask lanes = leave_outside(batch_.loaded());
  LaneMask undecided = 0;
  if (settings_.exhaustive) {
    const LaneMask leavable = settings_.split_certified ? at_minimum_width(lanes) : lanes;
    undecided = (lanes & ~leavable) | leave_small(leave_certified(leavable));
  } else {
    undecided = leave_certified(lanes);
    if (settings_.ingredients.midpoints) witness_.look_at_midpoints(batch_, lanes);
    look_for_witness(undecided);
    if (witness_.found()) {
      stopped_ = true;
      return;
    }
  }
  hopeless_ = hopeless_under_uncertainty(undecided);
  for (std::size_t lane = kLanes; lane-- > 0;)
    if (has_lane(undecided, lane))
      exhausted_ ? observer_.on_open(open_[lane]) : split_or_block(lane);
}

void Search::leave(std::size_t lane, Rule rule, Proof proof) noexcept {
  ++statistics_.leaves[static_cast<std::size_t>(rule)];
  if (settings_.enclose_determinants && rule != Rule::kOutside)
    proof.determinant = batch_.determinant(lane, problem_.alpha.hi > 0.0);
  observer_.on_leaf(open_[lane], rule, proof);
}

void Search::leave_with_witness(std::size_t lane) noexcept {
  Proof proof;
  proof.witness = &box_witness_.witness();
  proof.reason = box_witness_.reason();
  if (!first_witness_) first_witness_reason_ = proof.reason, first_witness_ = *proof.witness;
  leave(lane, Rule::kWitness, proof);
}

void Search::leave_undecided(std::size_t lane, Reason reason) noexcept {
  Proof proof;
  proof.reason = reason;
  leave(lane, Rule::kBlocked, proof);
}

/// The frontier is emptied: the search is over.
void Search::report_open() noexcept {
  for (; !frontier_.empty(); frontier_.pop()) observer_.on_open(frontier_.top());
}

/// Lanes that bisection is done with.
LaneMask Search::at_minimum_width(LaneMask lanes) noexcept {
  LaneMask result = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (!bisector_.choose(batch_, lane)) result |= 1U << lane;
  });
  return result;
}

LaneMask Search::leave_small(LaneMask lanes) noexcept {
  LaneMask rest = lanes;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (!box_witness_.small_throughout(batch_, lane)) return;
    leave_with_witness(lane);
    rest &= ~(1U << lane);
  });
  return rest;
}

LaneMask Search::leave_outside(LaneMask lanes) noexcept {
  const LaneMask outside = batch_.certain_outside();
  for_each_lane(outside, [this](std::size_t lane) { leave(lane, Rule::kOutside, {}); });
  return lanes & ~outside;
}

LaneMask Search::leave_certified(LaneMask lanes) noexcept {
  LaneMask anyway = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (open_[lane].depth % kEveryTest == kEveryTest - 1) anyway |= 1U << lane;
  });
  for (std::size_t t = 0; t < tests_.size() && lanes != 0; ++t) {
    const auto& test = tests_[t];
    const LaneMask certified = test->certify(batch_, lanes, anyway) & lanes;
    if (test->rule() == Rule::kFilter) count_filter(t, certified);
    const std::size_t order = vector_order(test->rule());
    for_each_lane(certified, [&](std::size_t lane) {
      const double* vector = order > 0 ? batch_.vector() + lane : nullptr;
      leave(lane, test->rule(), {batch_.preconditioner() + lane, vector, order});
    });
    lanes &= ~certified;
  }
  return lanes;
}

/// Filters are the last of the tests.
void Search::count_filter(std::size_t test, LaneMask certified) noexcept {
  const std::size_t ours = tests_.size() - filter_boxes_.size();
  filter_boxes_[test - ours] += static_cast<std::uint64_t>(std::popcount(certified));
}

std::size_t Search::vector_order(Rule rule) const noexcept {
  if (rule == Rule::kSecondOrder) return batch_.order();
  return rule == Rule::kHMatrix || rule == Rule::kMeanValue ? problem_.kernel->columns : 0;
}

/// Corners first, then downhill: from all of the variety when the number of boxes reaches a power
/// of four, so that the effort stays in proportion; with constraints from boxes inside them, since
/// only there a segment can be certified.
void Search::look_for_witness(LaneMask undecided) noexcept {
  if (undecided == 0 || !looking_for_witness()) return;
  if (statistics_.boxes < next_descent_) return;
  if (problem_.kernel->constraints > 0) {
    undecided &= batch_.certain_inside();
    if (undecided == 0) return;
    next_descent_ = statistics_.boxes + 1 + statistics_.boxes / 8;
  } else {
    if (next_descent_ == 1) witness_.look_at_corners();
    next_descent_ = 4 * statistics_.boxes;
  }
  std::size_t lane = 0;
  while (!has_lane(undecided, lane)) ++lane;
  witness_.descend(open_[lane].box);
}

void Search::split_or_block(std::size_t lane) noexcept {
  if (stopped_) return;
  if (settings_.exhaustive) return split_or_look_inside(lane);
  // No box that holds such a point will ever be certified in doubles.
  if (undefined_at_middle(lane)) {
    if (is_point(open_[lane].box) && certified_by_oracle(lane))
      return leave(lane, Rule::kMultiprecision, {});
    return block(lane, Reason::kUndefined);
  }
  if (has_lane(hopeless_, lane)) return block(lane, Reason::kUncertainty);
  const std::optional<std::size_t> variable = bisector_.choose(batch_, lane);
  if (variable) return split(lane, *variable);
  if (certified_by_oracle(lane)) return leave(lane, Rule::kMultiprecision, {});
  block(lane, reason_at_minimum_width(lane));
}

void Search::split_or_look_inside(std::size_t lane) noexcept {
  const std::optional<std::size_t> variable = bisector_.choose(batch_, lane);
  if (variable) return split(lane, *variable);
  if (certified_by_determinant(lane)) return leave(lane, Rule::kDeterminant, {});
  // More digits do not help a box that is wide: they cost much and decide nothing.
  if (cannot_be_halved(open_[lane].box) && certified_by_oracle(lane))
    return leave(lane, Rule::kMultiprecision, {});
  if (box_witness_.somewhere_in(open_[lane].box)) return leave_with_witness(lane);
  block(lane, reason_at_minimum_width(lane));
}

Reason Search::reason_at_minimum_width(std::size_t lane) noexcept {
  LaneMask defined = batch_.certain_posed() & 1U << lane;
  static_cast<void>(batch_.product({}, defined));
  return defined != 0 ? Reason::kWidth : Reason::kUndefined;
}

void Search::split(std::size_t lane, std::size_t variable) noexcept {
  const OpenBox parent = open_[lane];
  const std::span<Interval> lower = box_of(lane);
  const Halves halves = *bisect(lower[variable]);
  observer_.on_split(parent,
                     {parent.id, static_cast<std::uint32_t>(variable), halves.left.hi, next_id_});
  std::copy(lower.begin(), lower.end(), half_.begin());
  lower[variable] = halves.left;
  half_[variable] = halves.right;
  const OpenBox first{next_id_, parent.depth + 1, lower};
  const OpenBox second{next_id_ + 1, parent.depth + 1, half_};
  next_id_ += 2;
  if (!frontier_.push_halves(first, bisector_.approx_relative_width(first.box), second,
                             bisector_.approx_relative_width(second.box))) {
    stop_at_open_box(Reason::kMemory);
    observer_.on_open(first);
    observer_.on_open(second);
  }
}

void Search::block(std::size_t lane, Reason reason) noexcept {
  leave_undecided(lane, reason);
  if (!blocked_) boxes_when_blocked_ = statistics_.boxes;
  // Near a pole many boxes are too narrow to split; the one that is undefined says why.
  if (!blocked_ || (reason == Reason::kUndefined && reason_ == Reason::kWidth)) {
    blocked_ = true;
    reason_ = reason;
    std::copy(open_[lane].box.begin(), open_[lane].box.end(), blocking_.begin());
  }
  const std::uint64_t blocked = statistics_.leaves[static_cast<std::size_t>(Rule::kBlocked)];
  if (!looking_for_witness() || blocked > kMaxDescentsFromBlocked) return;
  witness_.descend(open_[lane].box);
  stopped_ = witness_.found();
}

/// The box of a lane with its first variables fixed at their midpoints, to a lane of center_.
void Search::load_center(std::size_t lane, std::size_t thin_variables,
                         std::size_t center) noexcept {
  std::copy(open_[lane].box.begin(), open_[lane].box.end(), half_.begin());
  for (std::size_t k = 0; k < thin_variables; ++k) half_[k] = Interval(mid(half_[k]));
  if (center == 0) center_.clear();
  center_.load(center, half_);
}

/// J⁻¹ or the pose is not defined at the middle of the box, which may lie in the variety.
bool Search::undefined_at_middle(std::size_t lane) noexcept {
  if (has_lane(batch_.midpoint_outside(), lane)) return false;
  if (!has_lane(batch_.midpoint_defined(), lane)) return true;
  if (has_lane(batch_.certain_posed(), lane)) return false;
  load_center(lane, problem_.kernel->variables, 0);
  center_.seal(1);
  return center_.certain_posed() == 0;
}

/// Both ways of enclosing the determinant together: the tests look at K·A or at A alone.
bool Search::certified_by_determinant(std::size_t lane) noexcept {
  if (problem_.kernel->rows != problem_.kernel->columns) return false;
  const std::optional<Interval> determinant = batch_.determinant(lane, false);
  return determinant && batch_.certain_above_threshold(lane, mig(*determinant));
}

/// The last resort for a box that cannot be split: more digits than doubles have.
bool Search::certified_by_oracle(std::size_t lane) noexcept {
  const regulus_kernel& kernel = *problem_.kernel;
  if (settings_.oracle == nullptr || kernel.rows != kernel.columns) return false;
  if (!has_lane(batch_.certain_posed(), lane)) return false;
  const std::optional<Interval> determinant = settings_.oracle->enclose(open_[lane].box);
  return determinant && batch_.certain_above_threshold(lane, mig(*determinant));
}

/// At the middle of the box, as a single pose, the tests fail for the whole of the uncertainty: no
/// box around that pose can do better, except by the rounding of K. Asked now and then.
LaneMask Search::hopeless_under_uncertainty(LaneMask lanes) noexcept {
  if (!keeps_uncertainty_whole_ || settings_.exhaustive || !settings_.ingredients.stall) return 0;
  std::size_t asked[kLanes], count = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (open_[lane].depth % kStallCheck != kStallCheck - 1) return;
    load_center(lane, problem_.kernel->motion_variables, count);
    asked[count++] = lane;
  });
  if (count == 0) return 0;
  center_.seal(count);
  LaneMask left = center_.loaded() & ~center_.certain_outside();
  for (const auto& test : tests_)
    if (left != 0) left &= ~test->certify(center_, left, left);
  LaneMask hopeless = 0;
  for_each_lane(left, [&](std::size_t center) { hopeless |= 1U << asked[center]; });
  return hopeless;
}

Result Search::conclude() {
  Result result;
  result.method = settings_.method;
  result.stopped_by = stopped_by_;
  statistics_.max_frontier = frontier_.max_size();
  statistics_.probes = witness_.probes() + box_witness_.probes();
  if (first_witness_) {
    result.verdict = Verdict::kSingularity;
    result.reason = first_witness_reason_;
    result.witness = first_witness_;
  } else if (witness_.found()) {
    result.verdict = Verdict::kSingularity;
    result.reason = witness_.reason();
    result.witness = witness_.witness();
  } else if (!blocked_ && !exhausted_ && frontier_.empty()) {
    result.verdict = Verdict::kNoSingularity;
    result.reason = Reason::kAllBoxesCertified;
  } else {
    result.verdict = Verdict::kPossibleProblem;
    result.reason = reason_;
    result.blocking_box = blocking_;
  }
  statistics_.seconds = seconds_since(start_);
  result.statistics = statistics_;
  result.filter_boxes = filter_boxes_;
  return result;
}

/// Kept out of line, so that no floating-point work moves out of the rounding scope of its caller.
[[gnu::noinline]] Result search(const Problem& problem, const Settings& settings,
                                std::span<const OpenBox> open, BoxId next_id, Observer* observer) {
  return Search(problem, settings, observer).run(open, next_id);
}

Result faulty(const Settings& settings) {
  Result result;
  result.method = settings.method;
  result.reason = Reason::kBadProblem;
  return result;
}

/// Uncertain quantities that are kept whole have their whole range in every box.
bool keeps_ranges(const Problem& problem, const Settings& settings, const OpenBox& open) noexcept {
  if (open.box.size() != problem.outer.size()) return false;
  if (settings.uncertainty == Uncertainty::kVariables) return true;
  const std::size_t first = problem.kernel->motion_variables;
  return std::equal(open.box.begin() + static_cast<std::ptrdiff_t>(first), open.box.end(),
                    problem.outer.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

Result resume(const Problem& problem, const Settings& settings, std::span<const OpenBox> open,
              BoxId next_id, Observer* observer) {
  if (find_fault(problem, settings)) return faulty(settings);
  for (const OpenBox& box : open)
    if (!keeps_ranges(problem, settings, box)) return faulty(settings);
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  return search(problem, settings, open, next_id, observer);
}

Result solve(const Problem& problem, const Settings& settings, Observer* observer) {
  const OpenBox root{0, 0, problem.outer};
  return resume(problem, settings, {&root, 1}, 1, observer);
}

}  // namespace regulus
