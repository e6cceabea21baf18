// SPDX-License-Identifier: Apache-2.0
#include "runtime/embedded/piece_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/kernel/rounding_scope.hpp"

namespace regulus::detail {
namespace {

/// The number of boxes after which a piece is searched for a witness by other means than midpoints.
constexpr unsigned kFirstDescent = 4;

/// Widths of pieces that are tried as easy ones: the least one is a ten-thousandth of the ranges.
constexpr unsigned kEasyWidths = 32;
constexpr double kNextEasyWidth = 0.75;

/// Witnesses may lie anywhere in the ranges, which are exact here. The coordinates of a point in a
/// ball are an exception: the range is a side of the box around it, so a witness covers the range.
std::vector<std::optional<Interval>> witness_ranges(const regulus_kernel& kernel,
                                                    std::span<const Interval> ranges) {
  std::vector<std::optional<Interval>> inner(ranges.begin(), ranges.end());
  const int* ball = kernel.expansion == nullptr ? nullptr : kernel.expansion->ball_of_variable;
  for (std::size_t k = 0; ball != nullptr && k < inner.size(); ++k)
    if (ball[k] >= 0) inner[k].reset();
  return inner;
}

Problem make_problem(const regulus_kernel& kernel, std::span<const Interval> ranges, double alpha) {
  Problem problem;
  problem.kernel = &kernel;
  problem.outer.assign(ranges.begin(), ranges.end());
  problem.inner = witness_ranges(kernel, ranges);
  // A negative number or a NaN is a fault that is found below.
  problem.alpha.lo = problem.alpha.hi = alpha;
  return problem;
}

const Problem& sound(const Problem& problem, const Settings& settings, unsigned max_boxes) {
  if (max_boxes < 1 || max_boxes > Checker::kMaxBoxes)
    throw std::invalid_argument("the number of boxes is not from 1 to 1048576");
  if (const auto fault = find_fault(problem, settings)) throw std::invalid_argument(*fault);
  return problem;
}

bool within(Interval part, Interval whole) noexcept {
  return whole.lo <= part.lo && part.lo <= part.hi && part.hi <= whole.hi;
}

/// Returns how many boxes may wait together. Each evaluated box adds at most one to the kLanes boxes
/// at the start. On the way to the minimum width, kLanes boxes are taken at once; they leave at most
/// their halves waiting at each level of splitting.
std::size_t most_open_boxes(std::size_t parameters, const Settings& settings, unsigned max_boxes) {
  const double halvings = 1.0 - std::log2(settings.min_relative_width);
  const std::size_t on_the_way = 2 * kLanes * (parameters * std::size_t(std::ceil(halvings)) + 1);
  return kLanes + std::min<std::size_t>(on_the_way, std::size_t{max_boxes} + 1);
}

bool has_width(Interval x) noexcept { return x.lo < x.hi; }

/// Cuts a range into up to `most` ≤ kLanes parts, which cover it.
std::size_t cut(Interval range, std::size_t most, Interval* parts) noexcept {
  std::size_t count = 1;
  parts[0] = range;
  while (count < most) {
    const std::optional<Halves> halves = bisect(parts[0]);  // the oldest part: no other is wider
    if (!halves) break;
    std::rotate(parts, parts + 1, parts + count);
    parts[count - 1] = halves->left;
    parts[count++] = halves->right;
  }
  return count;
}

}  // namespace

PieceSearch::PieceSearch(const regulus_kernel& kernel, std::span<const Interval> ranges,
                         unsigned max_boxes, double alpha)
    : problem_(make_problem(kernel, ranges, alpha)),
      structure_(find_row_structure(sound(problem_, settings_, max_boxes), settings_)),
      max_boxes_(max_boxes),
      decider_(problem_, settings_, structure_, true),
      batch_(kernel, decider_.order()),
      witness_(problem_, settings_, false),
      frontier_(kernel.variables, most_open_boxes(kernel.motion_variables, settings_, max_boxes)),
      loop_(*this, frontier_, decider_.bisector(), kernel.variables),
      half_(kernel.variables),
      piece_(kernel.variables),
      places_(2 * std::size_t{kernel.variables}) {
  // This check makes everything that is initialised on first use, and shows how to split.
  static_cast<void>(check({problem_.outer.data(), kernel.motion_variables}));
  learns_splits_ = false;
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  learn_easy_widths();
}

/// Returns true if this easy test suffices for eight boxes of this relative width, along a diagonal
/// of the ranges.
bool PieceSearch::all_easy(std::size_t test, double width) noexcept {
  batch_.clear();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double at = (1.0 - width) * double(i) / double(kLanes - 1);
    std::copy(problem_.outer.begin(), problem_.outer.end(), half_.begin());
    for (std::size_t k = 0; k < kernel().motion_variables; ++k) {
      const Interval whole = problem_.outer[k];
      const double lo = std::clamp(whole.lo + at * (whole.hi - whole.lo), whole.lo, whole.hi);
      half_[k] = {lo, std::clamp(lo + width * (whole.hi - whole.lo), lo, whole.hi)};
    }
    batch_.add({0, 0, half_});
  }
  return decider_.all_easy(test, batch_);
}

/// Finds the width of pieces for which an easy test pays. It costs a fraction of what it saves, so a
/// rough answer is good enough. Not inlined, for the same reason as search().
[[gnu::noinline]] void PieceSearch::learn_easy_widths() noexcept {
  for (std::size_t t = 0; t < decider_.easy_tests(); ++t) {
    double width = 1.0;
    for (unsigned i = 0; i < kEasyWidths && easy_width_[t] == 0.0; ++i, width *= kNextEasyWidth)
      if (all_easy(t, width)) easy_width_[t] = width;
  }
}

/// Not inlined, so that no floating-point work moves out of the rounding scope of its caller.
[[gnu::noinline]] Check PieceSearch::search(std::span<const Interval> piece) noexcept {
  boxes_ = 0;
  certified_ = stopped_ = looked_inside_ = false;
  check_ = {};
  threshold_ = {};
  witness_.forget();
  load_frontier(piece);
  loop_.run();
  if (stopped_) return check_;
  check_.verdict = certified_ ? Verdict::kNoSingularity : Verdict::kPossibleProblem;
  check_.reason = certified_ ? Reason::kAllBoxesCertified : Reason::kEmptyVariety;
  check_.boxes = boxes_;
  return check_;
}

Check PieceSearch::check(std::span<const Interval> piece) noexcept {
  bool fits = piece.size() == kernel().motion_variables;
  for (std::size_t k = 0; fits && k < piece.size(); ++k) fits = within(piece[k], problem_.outer[k]);
  if (!fits) return {};
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  return search(piece);
}

/// Remembers the first variable that was split at each of the first levels.
BoxId PieceSearch::number(const OpenBox& parent, std::uint32_t variable, double) noexcept {
  if (learns_splits_ && known_splits_ < kFirstSplits && parent.depth == known_splits_)
    first_splits_[known_splits_++] = variable;
  return 0;
}

void PieceSearch::push(std::span<const Interval> box) noexcept {
  static_cast<void>(
      frontier_.push_top({0, 0, box}, decider_.bisector().approx_relative_width(box)));
}

/// Pushes the parts of half_ that the first splits from `split` on give.
void PieceSearch::push_parts(std::size_t split) noexcept {
  if (split == known_splits_) return push(half_);
  Interval& range = half_[first_splits_[split]];
  const Interval whole = range;
  const std::optional<Halves> halves = bisect(whole);
  if (!halves) return push_parts(split + 1);
  range = halves->right;
  push_parts(split + 1);
  range = halves->left;
  push_parts(split + 1);
  range = whole;
}

/// The cost of a batch does not depend on its number of boxes. So a piece starts as up to eight
/// boxes: those of the first splits of the whole ranges. If it can be split in one variable only,
/// such as a trajectory, it starts as eight parts.
void PieceSearch::load_frontier(std::span<const Interval> piece) noexcept {
  std::copy(problem_.outer.begin(), problem_.outer.end(), half_.begin());
  std::copy(piece.begin(), piece.end(), half_.begin());
  std::copy(half_.begin(), half_.end(), piece_.begin());
  frontier_.clear();
  if (std::count_if(piece.begin(), piece.end(), has_width) != 1)
    return !learns_splits_ && max_boxes_ >= kLanes ? push_parts(0) : push(half_);
  const auto wide = std::find_if(piece.begin(), piece.end(), has_width) - piece.begin();
  Interval parts[kLanes];
  const std::size_t count =
      cut(piece[std::size_t(wide)], std::min(std::size_t{max_boxes_}, kLanes), parts);
  for (std::size_t i = 0; i < count; ++i) {
    half_[std::size_t(wide)] = parts[i];
    push(half_);
  }
}

bool PieceSearch::begin_round() noexcept {
  if (!stopped_ && boxes_ == max_boxes_) stop_at(Reason::kBoxBudget, frontier_.top().box);
  return !stopped_;
}

std::size_t PieceSearch::decide_round() noexcept {
  batch_.clear();
  for (; batch_.count() < kLanes && boxes_ < max_boxes_ && !frontier_.empty(); ++boxes_) {
    const OpenBox box = frontier_.top();
    const double width = decider_.bisector().approx_relative_width(box.box);
    for (std::size_t t = 0; t < easy_width_.size(); ++t)
      if (width <= easy_width_[t]) batch_.easy[t] |= 1U << batch_.count();
    batch_.add(box);
    frontier_.pop();
  }
  batch_.budget.threshold = threshold_;
  decider_.decide(batch_, false);  // the search is not exhaustive: nothing is allocated
  return 1;
}

/// Looks downhill and at corners of the piece once, if the first boxes are not enough: that takes
/// longer than some boxes.
void PieceSearch::look_for_witness(Decisions& batch) noexcept {
  witness_.look_at_midpoints(batch);
  if (witness_.found() || looked_inside_ || batch.uncertified == 0 || boxes_ < kFirstDescent)
    return;
  looked_inside_ = true;
  static_cast<void>(witness_.look_inside(piece_));
}

bool PieceSearch::conclude(Decisions& batch) noexcept {
  for (std::size_t t = 0; t < batch.budget.trials; ++t) threshold_.learn(batch.budget.trial[t]);
  look_for_witness(batch);
  if (!witness_.found()) return true;
  const std::size_t variables = kernel().variables;
  for (std::size_t p = 0; p < witness_.points(); ++p)
    witness_.copy_point(p, {places_.data() + p * variables, variables});
  check_ = {Verdict::kSingularity,
            witness_.reason(),
            boxes_,
            {places_.data(), witness_.points() * variables}};
  stopped_ = true;
  return false;
}

void PieceSearch::settle(Decisions& batch, std::size_t lane) noexcept {
  const Decision& decision = batch.decision[lane];
  if (decision.rule == Rule::kBlocked)
    stop_at(decision.reason, batch.box_of(lane));
  else if (decision.rule != Rule::kOutside)
    certified_ = true;
}

/// In fact there is always room: see most_open_boxes. Without room a box would be lost, and then
/// nothing may be claimed.
void PieceSearch::lose(const OpenBox& first, const OpenBox&) noexcept {
  stop_at(Reason::kBoxBudget, first.box);
}

void PieceSearch::stop_at(Reason reason, std::span<const Interval> box) noexcept {
  std::copy(box.begin(), box.end(), places_.begin());
  check_ = {Verdict::kPossibleProblem, reason, boxes_, {places_.data(), box.size()}};
  stopped_ = true;
}

}  // namespace regulus::detail
