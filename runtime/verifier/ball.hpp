// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arb.h>

#include <cmath>

#include "runtime/verifier/interval.hpp"

namespace regulus::verifier {

/// An owned arb_t.
class Ball {
 public:
  Ball() noexcept { arb_init(value_); }
  Ball(const Ball& other) noexcept : Ball() { arb_set(value_, other.value_); }
  Ball& operator=(const Ball& other) noexcept {
    arb_set(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  /// Encloses x, exactly if x is thin.
  explicit Ball(Interval x, long bits) noexcept : Ball() {
    if (!is_bounded(x)) {
      arb_zero_pm_inf(value_);
      return;
    }
    arf_t lo, hi;
    arf_init(lo), arf_init(hi);
    arf_set_d(lo, x.lo), arf_set_d(hi, x.hi);
    arb_set_interval_arf(value_, lo, hi, bits);
    if (is_thin(x)) arb_set_arf(value_, lo);
    arf_clear(lo), arf_clear(hi);
  }

  [[nodiscard]] arb_ptr get() noexcept { return value_; }
  [[nodiscard]] arb_srcptr get() const noexcept { return value_; }

  /// Returns an interval that is not bounded if the ball is not finite.
  [[nodiscard]] Interval enclosure() const noexcept {
    if (!arb_is_finite(value_)) return everything();
    arf_t bound;
    arf_init(bound);
    arb_get_lbound_arf(bound, value_, 64);
    const double lo = arf_get_d(bound, ARF_RND_FLOOR);
    arb_get_ubound_arf(bound, value_, 64);
    const double hi = arf_get_d(bound, ARF_RND_CEIL);
    arf_clear(bound);
    return {lo, hi};
  }

 private:
  arb_t value_;
};

}  // namespace regulus::verifier
