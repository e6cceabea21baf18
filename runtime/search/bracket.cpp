// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/bracket.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace regulus {
namespace {

/// The part of the remaining time that one attempt may take. The value half-way to a ceiling takes
/// four times as long as the value before. If it takes kPatience times as long, it met a ceiling.
constexpr double kMostShare = 0.5;
/// If less time remains than this many times the last attempt, one more gets nearly all of it.
constexpr double kLastAttempt = 3;
constexpr double kLastShare = 0.95;
constexpr double kLeastShare = 0.05;
constexpr double kPatience = 20;
/// The part of an attempt's time that its value should need; the prediction is rough.
constexpr double kPlannedPart = 0.6;
/// No attempt is planned between a certified value and an obstacle if they are nearer than this
/// part of the wanted gap.
constexpr double kResolution = 0.125;
/// A smaller number of boxes does not show how the number grows.
constexpr std::uint64_t kTellingBoxes = 32;
/// If a failure was for lack of time, it is repeated with this many times as much.
constexpr double kWorthMoreTime = 2.0;
constexpr double kLeastStep = 0.125;
/// If there is no upper end and no pose remains up to this value, larger values are not searched.
constexpr double kMostEmpty = 0x1p20;

bool for_want_of_time(Reason reason) noexcept {
  return reason == Reason::kTimeBudget || reason == Reason::kBoxBudget ||
         reason == Reason::kInterrupted;
}

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
    failures_.push_back({attempt.value, attempt.seconds, for_want_of_time(attempt.reason)});
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

std::optional<PlannedAttempt> Bracket::next() const {
  if (closed() || !(seconds_left() > 0)) return std::nullopt;
  if (!certified_) {
    if (failed_at(low_)) return std::nullopt;
    return PlannedAttempt{low_, seconds_left()};
  }
  const double last = successes_.back().seconds;
  const double most = seconds_left() < kLastAttempt * last ? kLastShare : kMostShare;
  const double seconds =
      std::clamp(kPatience * last, kLeastShare * seconds_left(), most * seconds_left());
  const double top = lowest_obstacle(seconds);
  if (top == kInfinity && certified_ == empty_ && *certified_ >= kMostEmpty) return std::nullopt;
  if (top == kInfinity) return PlannedAttempt{std::max(2 * *certified_, 1.0), seconds};
  if (top > high_) return PlannedAttempt{high_, seconds};
  if (top - *certified_ <= kResolution * limits_.gap * top) return std::nullopt;
  const double value = short_decimal_near(aim(top, seconds), *certified_, top);
  if (!(*certified_ < value && value < top)) return std::nullopt;
  return PlannedAttempt{value, seconds};
}

std::optional<PlannedAttempt> Bracket::next_to_refute() const {
  if (closed() || !(seconds_left() > 0) || !certified_ || !refuted_) return std::nullopt;
  double low = *certified_;
  for (const Failure& failure : failures_)
    if (failure.value < *refuted_) low = std::max(low, failure.value);
  if (*refuted_ - low <= kResolution * limits_.gap * *refuted_) return std::nullopt;
  const double value = short_decimal_near(0.5 * (low + *refuted_), low, *refuted_);
  if (!(low < value && value < *refuted_)) return std::nullopt;
  return PlannedAttempt{value, kLeastShare * seconds_left()};
}

/// Returns the least value not worth an attempt of so many seconds; a value above high_ if none.
double Bracket::lowest_obstacle(double seconds) const noexcept {
  double top = kInfinity;
  if (refuted_) top = *refuted_;
  for (const Failure& failure : failures_)
    if (failure.value > *certified_ &&
        !(failure.for_want_of_time && seconds > kWorthMoreTime * failure.seconds))
      top = std::min(top, failure.value);
  return top == kInfinity && high_ < kInfinity ? std::nextafter(high_, kInfinity) : top;
}

/// Returns the value half-way up, or a smaller one if that would take too long.
double Bracket::aim(double top, double seconds) const noexcept {
  const double width = top - *certified_;
  const double half = *certified_ + 0.5 * width;
  const std::optional<double> most = affordable(kPlannedPart * seconds);
  if (!most) return half;
  return std::clamp(*most, *certified_ + kLeastStep * width, half);
}

/// Predicts the value that takes so long: √time is a/(c − value), and two values give a and c.
std::optional<double> Bracket::affordable(double seconds) const noexcept {
  if (successes_.size() < 2) return std::nullopt;
  const Attempt& first = successes_[successes_.size() - 2];
  const Attempt& second = successes_.back();
  if (first.boxes < kTellingBoxes || second.boxes <= first.boxes) return std::nullopt;
  const double ratio = std::sqrt(double(second.boxes) / double(first.boxes));
  const double ceiling = (ratio * second.value - first.value) / (ratio - 1);
  const double shrink = std::sqrt(second.seconds / seconds);
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

}  // namespace regulus
