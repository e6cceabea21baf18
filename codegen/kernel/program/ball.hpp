// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <arb.h>

#include "codegen/kernel/program/flint_rational.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// An owned arb_t: a ball [m − r, m + r] that encloses a real number.
class Ball {
 public:
  Ball() noexcept { arb_init(value_); }
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(value_, other.value_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  /// The double itself. NaN and infinities become the whole line.
  explicit Ball(double x);

  /// A ball around the interval, at `precision` bits.
  ///
  /// Ensures   interval ⊆ ball.
  Ball(const Interval& interval, long precision);

  /// A ball around the rational, at `precision` bits.
  Ball(const FlintRational& value, long precision);
  Ball(const cln::cl_RA& value, long precision);

  [[nodiscard]] arb_ptr get() noexcept { return value_; }
  [[nodiscard]] arb_srcptr get() const noexcept { return value_; }

  /// Returns the narrowest interval with double bounds around the ball; infinite bounds if there is
  /// none.
  [[nodiscard]] Interval enclosure() const;

 private:
  arb_t value_;
};

}  // namespace regulus::detail
