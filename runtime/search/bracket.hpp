// SPDX-License-Identifier: Apache-2.0
// Chooses the next value to try in a search for the largest safe value. It only decides where to
// search: the searches at the tried values claim what is safe and what is not.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/problem/result.hpp"

namespace regulus::detail {

inline constexpr std::uint64_t kAnyBoxes = std::numeric_limits<std::uint64_t>::max();

/// A planned search: its value, and the most boxes and the longest time that it may take.
struct PlannedAttempt {
  double value = 0;
  std::uint64_t boxes = kAnyBoxes;
  double seconds = std::numeric_limits<double>::infinity();
};

/// A search that was made at one value.
struct Attempt {
  double value = 0;
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  std::uint64_t boxes = 0;
  double seconds = 0;
  std::uint64_t most_boxes = kAnyBoxes;  ///< that it was allowed
};

/// Approaches the largest safe value between `low` and `high`. A larger value means a larger set,
/// or a larger threshold, so a value below a safe value is safe.
///
/// The boxes for a value grow about as 1/(c − value)² towards a ceiling c, which is the least value
/// that is not safe, or the limit of the tests. Two certified values give c roughly. A search may
/// take twenty times as many boxes as the last one, and no value is tried that would take more.
///
/// The values depend on the outcomes and on the numbers of boxes, not on the time: a search is
/// stopped if it takes more than half of the remaining time, and no other choice looks at the clock.
class Bracket {
 public:
  struct Limits {
    double gap = 0.01;  ///< relative
    double seconds = std::numeric_limits<double>::infinity();
    std::uint64_t boxes = kAnyBoxes;  ///< of each search
  };

  /// Requires  0 ≤ low < high; high may be infinite.
  Bracket(double low, double high, const Limits& limits);

  void note(const Attempt& attempt);
  /// A witness shows that this value is not safe.
  void note_refuted(double value) noexcept;
  /// Adds time that was used for other work.
  void spend(double seconds) noexcept { spent_ += seconds; }

  /// Returns nullopt if the bracket is closed, time is over, or no value in between is promising.
  [[nodiscard]] std::optional<PlannedAttempt> next() const;

  /// Plans a search that may lower the refuted value, after next() has returned nullopt: half-way to
  /// the highest value that was not decided.
  [[nodiscard]] std::optional<PlannedAttempt> next_to_refute() const;

  [[nodiscard]] std::optional<double> certified() const noexcept { return certified_; }
  [[nodiscard]] std::optional<double> refuted() const noexcept { return refuted_; }
  /// Returns (refuted − certified)/refuted; nullopt unless there are both.
  [[nodiscard]] std::optional<double> gap() const noexcept;
  /// Returns the largest certified value at which no pose remains: nothing there can be singular.
  [[nodiscard]] std::optional<double> empty() const noexcept { return empty_; }
  /// True if the gap is as small as wanted, or all values up to `high` are safe, or `low` is not.
  [[nodiscard]] bool closed() const noexcept;
  [[nodiscard]] double seconds_left() const noexcept { return limits_.seconds - spent_; }

 private:
  /// A value that was neither certified nor refuted.
  struct Failure {
    double value;
    std::uint64_t most_boxes;
    bool for_want_of_boxes;  ///< more boxes might have helped
  };

  [[nodiscard]] bool failed_at(double value) const noexcept;
  [[nodiscard]] std::uint64_t boxes_of_next() const noexcept;
  [[nodiscard]] double seconds_of_next() const noexcept;
  [[nodiscard]] double lowest_obstacle(std::uint64_t boxes) const noexcept;
  [[nodiscard]] double aim(double top, std::uint64_t boxes) const noexcept;
  [[nodiscard]] std::optional<double> affordable(double boxes) const noexcept;

  double low_, high_;
  Limits limits_;
  double spent_ = 0;
  std::optional<double> certified_, refuted_, empty_;
  std::vector<Attempt> successes_;  ///< increasing
  std::vector<Failure> failures_;
};

/// Returns a decimal of few digits strictly between lo and hi, within (hi − lo)/32 of `value`.
///
/// Requires  lo < value < hi.
/// Ensures   lo < result < hi; the double nearest to a decimal, or `value` itself.
[[nodiscard]] double short_decimal_near(double value, double lo, double hi) noexcept;

/// Returns a decimal of five digits that is not below `value`, by less than 10⁻⁴ of it.
///
/// Requires  value ≥ 0, finite.
[[nodiscard]] double short_decimal_above(double value) noexcept;

}  // namespace regulus::detail
