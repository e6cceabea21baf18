// SPDX-License-Identifier: Apache-2.0
// Which value to try next when the largest safe one is sought. Only where to look is decided here:
// what is safe and what is not are claims of the searches made at the values tried.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/problem/result.hpp"

namespace regulus {

/// A search that was made at one value.
struct Attempt {
  double value = 0;
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// A search to make: at which value, and for how long at most.
struct PlannedAttempt {
  double value = 0;
  double seconds = 0;
};

/// Closes in on the largest safe value between `low` and `high`; the larger the value, the larger
/// the set, or the threshold, so that safe at one value is safe below it.
///
/// The time a value takes grows about as 1/(c − value)² towards a ceiling c, which is the least
/// value that is not safe, or the end of what the tests can show. Two certified values give c
/// roughly; no value is tried that would then take more than half of the time left.
class Bracket {
 public:
  struct Limits {
    double gap = 0.01;  ///< relative
    double seconds = std::numeric_limits<double>::infinity();
  };

  /// Requires  0 ≤ low < high; high may be infinite.
  Bracket(double low, double high, const Limits& limits);

  void note(const Attempt& attempt);
  /// A witness shows that this value is not safe.
  void note_refuted(double value) noexcept;
  /// Time that went elsewhere.
  void spend(double seconds) noexcept { spent_ += seconds; }

  /// nullopt: the bracket is closed, time is up, or nothing in between is likely to be certified.
  [[nodiscard]] std::optional<PlannedAttempt> next() const;

  [[nodiscard]] std::optional<double> certified() const noexcept { return certified_; }
  [[nodiscard]] std::optional<double> refuted() const noexcept { return refuted_; }
  /// (refuted − certified)/refuted; nullopt unless there are both.
  [[nodiscard]] std::optional<double> gap() const noexcept;
  /// Of those, the largest at which no pose remains: there is nothing that could be singular.
  [[nodiscard]] std::optional<double> empty() const noexcept { return empty_; }
  /// The gap is as small as wanted, or all values up to `high` are safe, or `low` is not.
  [[nodiscard]] bool closed() const noexcept;
  [[nodiscard]] double seconds_left() const noexcept { return limits_.seconds - spent_; }

 private:
  /// A value that was neither certified nor refuted.
  struct Failure {
    double value;
    double seconds;
    bool for_want_of_time;  ///< more of it might have helped
  };

  [[nodiscard]] bool failed_at(double value) const noexcept;
  [[nodiscard]] double lowest_obstacle(double seconds) const noexcept;
  [[nodiscard]] double aim(double top, double seconds) const noexcept;
  [[nodiscard]] std::optional<double> affordable(double seconds) const noexcept;

  double low_, high_;
  Limits limits_;
  double spent_ = 0;
  std::optional<double> certified_, refuted_, empty_;
  std::vector<Attempt> successes_;  ///< rising
  std::vector<Failure> failures_;
};

/// A decimal of few digits strictly between lo and hi, near `value`: within a 32nd of hi − lo.
///
/// Requires  lo < value < hi.
/// Ensures   lo < result < hi; the double nearest to a decimal, or `value` itself.
[[nodiscard]] double short_decimal_near(double value, double lo, double hi) noexcept;

/// A decimal of five digits that is not below `value`, by less than 10⁻⁴ of it.
///
/// Requires  value ≥ 0, finite.
[[nodiscard]] double short_decimal_above(double value) noexcept;

}  // namespace regulus
