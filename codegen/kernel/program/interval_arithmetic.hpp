// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// The interpreter's arithmetic on intervals of doubles.
///
/// Ensures   unless undefined(), the program is defined at every point of the operands and each
///           interval contains its values there. Results of guarded operations (those that
///           runtime/kernel/pack.hpp guards) beyond `largest` in magnitude count as undefined.
/// Rounding  outward; MXCSR must be at nearest.
class IntervalArithmetic {
 public:
  using Number = Interval;

  explicit IntervalArithmetic(double largest = kInfinity) noexcept : largest_(largest) {}

  [[nodiscard]] bool undefined() const noexcept { return undefined_; }
  void clear() noexcept { undefined_ = false; }

  [[nodiscard]] Interval constant(const cln::cl_RA& value) const;
  [[nodiscard]] Interval pi() const noexcept { return kPi; }
  [[nodiscard]] Interval negate(Interval a) const noexcept { return -a; }
  [[nodiscard]] Interval add(Interval a, Interval b) const noexcept { return a + b; }
  [[nodiscard]] Interval subtract(Interval a, Interval b) const noexcept { return a - b; }
  [[nodiscard]] Interval multiply(Interval a, Interval b) const noexcept { return a * b; }
  [[nodiscard]] Interval divide(Interval a, Interval b) noexcept;
  [[nodiscard]] Interval power(Interval a, unsigned exponent) const noexcept;
  [[nodiscard]] Interval atan2(Interval a, Interval b) noexcept;

  /// The functions of one argument, kSqrt … kAbs.
  [[nodiscard]] Interval call(Op function, Interval a);

 private:
  [[nodiscard]] Interval guarded(Interval result) noexcept;

  double largest_;
  bool undefined_ = false;
};

}  // namespace regulus::detail
