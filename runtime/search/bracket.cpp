// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/bracket.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace regulus::detail {
namespace {

/// The part of the remaining time that one attempt may take.
constexpr double kMostShare = 0.5;
/// If less time remains than this many times the last attempt, one more gets nearly all of it.
constexpr double kLastAttempt = 3;
constexpr double kLastShare = 0.95;
/// The value half-way to a ceiling takes four times as many boxes as the value before. If it takes
/// kBracketPatience times as many, it met a ceiling.
constexpr std::uint64_t kBracketPatience = 20;
/// So many boxes are always worth an attempt: a second of work, or less.
constexpr std::uint64_t kFewBoxes = 1 << 16;
/// The part of an attempt's boxes that its value should need; the prediction is rough.
constexpr double kPlannedPart = 0.6;
/// No attempt is planned between a certified value and an obstacle if they are nearer than this
/// part of the wanted gap.
constexpr double kResolution = 0.125;
/// A smaller number of boxes does not show how the number grows.
constexpr std::uint64_t kTellingBoxes = 32;
/// If a failure was for lack of boxes, it is repeated with more than this many times as many.
constexpr std::uint64_t kWorthMoreBoxes = 2;
constexpr double kLeastStep = 0.125;
/// If there is no upper end and no pose remains up to this value, larger values are not searched.
constexpr double kMostEmpty = 0x1p20;

/// Returns the double nearest to `value` written with so many significant digits.
double to_digits(double value, int digits) noexcept {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
  double result = value;
  std::from_chars(text, end.ptr, result);
  return result;
}

constexpr int kAllDigits = std::numeric_limits<double>::max_digits10;

}  // namespace

Bracket::Bracket(double low, double high, const Limits& limits)
    : low_(low), high_(high), limits_(limits) {}

void Bracket::note(const Attempt& attempt) {
  spent_ += attempt.seconds;
  if (attempt.verdict == Verdict::kSingularity) return note_refuted(attempt.value);
  if (attempt.reason == Reason::kEmptyVariety) {
    empty_ = std::max(empty_.value_or(attempt.value), attempt.value);
  } else if (attempt.verdict != Verdict::kNoSingularity) {
    failures_.push_back({attempt.value, attempt.most_boxes, attempt.reason == Reason::kBoxBudget});
    return;
  }
  certified_ = std::max(certified_.value_or(attempt.value), attempt.value);
  successes_.push_back(attempt);
  std::sort(successes_.begin(), successes_.end(),
            [](const Attempt& a, const Attempt& b) { return a.value < b.value; });
}

void Bracket::note_refuted(double value) noexcept {
  refuted_ = std::min(refuted_.value_or(value), value);
}

std::optional<double> Bracket::gap() const noexcept {
  if (!certified_ || !refuted_) return std::nullopt;
  return *refuted_ > 0 ? (*refuted_ - *certified_) / *refuted_ : 0.0;
}

bool Bracket::closed() const noexcept {
  if (refuted_ && *refuted_ <= low_) return true;
  if (certified_ && *certified_ >= high_) return true;
  return gap() && *gap() <= limits_.gap;
}

bool Bracket::failed_at(double value) const noexcept {
  return std::any_of(failures_.begin(), failures_.end(),
                     [value](const Failure& f) { return f.value == value; });
}

std::uint64_t Bracket::boxes_of_next() const noexcept {
  const std::uint64_t last = successes_.back().boxes;
  const std::uint64_t most =
      last < kAnyBoxes / kBracketPatience ? kBracketPatience * last : kAnyBoxes;
  return std::min(std::max(most, kFewBoxes), limits_.boxes);
}

double Bracket::seconds_of_next() const noexcept {
  const bool is_last = seconds_left() < kLastAttempt * successes_.back().seconds;
  return (is_last ? kLastShare : kMostShare) * seconds_left();
}

std::optional<PlannedAttempt> Bracket::next() const {
  if (closed() || !(seconds_left() > 0)) return std::nullopt;
  if (!certified_) {
    if (failed_at(low_)) return std::nullopt;
    return PlannedAttempt{low_, limits_.boxes, seconds_left()};
  }
  const std::uint64_t boxes = boxes_of_next();
  const double seconds = seconds_of_next();
  const double top = lowest_obstacle(boxes);
  if (top == kInfinity && certified_ == empty_ && *certified_ >= kMostEmpty) return std::nullopt;
  if (top == kInfinity) return PlannedAttempt{std::max(2 * *certified_, 1.0), boxes, seconds};
  if (top > high_) return PlannedAttempt{high_, boxes, seconds};
  if (top - *certified_ <= kResolution * limits_.gap * top) return std::nullopt;
  const double value = short_decimal_near(aim(top, boxes), *certified_, top);
  if (!(*certified_ < value && value < top)) return std::nullopt;
  return PlannedAttempt{value, boxes, seconds};
}

std::optional<PlannedAttempt> Bracket::next_to_refute() const {
  if (closed() || !(seconds_left() > 0) || !certified_ || !refuted_) return std::nullopt;
  double low = *certified_;
  for (const Failure& failure : failures_)
    if (failure.value < *refuted_) low = std::max(low, failure.value);
  if (*refuted_ - low <= kResolution * limits_.gap * *refuted_) return std::nullopt;
  const double value = short_decimal_near(0.5 * (low + *refuted_), low, *refuted_);
  if (!(low < value && value < *refuted_)) return std::nullopt;
  return PlannedAttempt{value, std::min(kFewBoxes, limits_.boxes), kMostShare * seconds_left()};
}

/// Returns the least value not worth an attempt of so many boxes; a value above high_ if none.
double Bracket::lowest_obstacle(std::uint64_t boxes) const noexcept {
  double top = kInfinity;
  if (refuted_) top = *refuted_;
  for (const Failure& failure : failures_)
    if (failure.value > *certified_ &&
        !(failure.for_want_of_boxes && boxes / kWorthMoreBoxes > failure.most_boxes))
      top = std::min(top, failure.value);
  return top == kInfinity && high_ < kInfinity ? std::nextafter(high_, kInfinity) : top;
}

/// Returns the value half-way up, or a smaller one if that would take too many boxes.
double Bracket::aim(double top, std::uint64_t boxes) const noexcept {
  const double width = top - *certified_;
  const double half = *certified_ + 0.5 * width;
  const std::optional<double> most = affordable(kPlannedPart * static_cast<double>(boxes));
  if (!most) return half;
  return std::clamp(*most, *certified_ + kLeastStep * width, half);
}

/// Predicts the value that takes so many: their root is a/(c − value), and two values give a and c.
std::optional<double> Bracket::affordable(double boxes) const noexcept {
  if (successes_.size() < 2) return std::nullopt;
  const Attempt& first = successes_[successes_.size() - 2];
  const Attempt& second = successes_.back();
  if (first.boxes < kTellingBoxes || second.boxes <= first.boxes) return std::nullopt;
  const double ratio = std::sqrt(double(second.boxes) / double(first.boxes));
  const double ceiling = (ratio * second.value - first.value) / (ratio - 1);
  const double shrink = std::sqrt(double(second.boxes) / boxes);
  return ceiling - shrink * (ceiling - second.value);
}

double short_decimal_near(double value, double lo, double hi) noexcept {
  for (int digits = 1; digits <= kAllDigits; ++digits) {
    const double rounded = to_digits(value, digits);
    if (lo < rounded && rounded < hi && std::fabs(rounded - value) <= (hi - lo) / 32)
      return rounded;
  }
  return value;
}

double short_decimal_above(double value) noexcept {
  constexpr int kDigits = 5;
  const double rounded = to_digits(value, kDigits);
  if (rounded >= value) return rounded;
  return to_digits(value * (1 + 0.6e-4), kDigits);
}

}  // namespace regulus::detail
