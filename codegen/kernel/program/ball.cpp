// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/ball.hpp"

#include <cmath>
#include <limits>

namespace regulus::detail {
namespace {

class Float {
 public:
  Float() noexcept { arf_init(value_); }
  explicit Float(double x) noexcept : Float() { arf_set_d(value_, x); }
  Float(const Float&) = delete;
  Float& operator=(const Float&) = delete;
  ~Float() { arf_clear(value_); }
  [[nodiscard]] arf_ptr get() noexcept { return value_; }

 private:
  arf_t value_;
};

}  // namespace

Ball::Ball(double x) : Ball() {
  if (std::isfinite(x))
    arb_set_d(value_, x);
  else
    arb_zero_pm_inf(value_);
}

Ball::Ball(const Interval& interval, long precision) : Ball() {
  if (!std::isfinite(interval.lo) || !std::isfinite(interval.hi)) {
    arb_zero_pm_inf(value_);
    return;
  }
  Float lo(interval.lo);
  Float hi(interval.hi);
  arb_set_interval_arf(value_, lo.get(), hi.get(), precision);
}

Ball::Ball(const FlintRational& value, long precision) : Ball() {
  arb_fmpz_div_fmpz(value_, fmpq_numref(value.get()), fmpq_denref(value.get()), precision);
}

Interval Ball::enclosure() const {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  constexpr long kBits = 64;
  if (!arb_is_finite(value_)) return Interval{-kUnbounded, kUnbounded};
  Float lo;
  Float hi;
  // Both roundings have one direction, so the doubles are those of the exact bounds. These may need
  // 2^60 bits: 1 ± 2^(−2^60).
  arb_get_lbound_arf(lo.get(), value_, kBits);
  arb_get_ubound_arf(hi.get(), value_, kBits);
  // The sum with +0 turns a −0 into +0.
  return Interval{arf_get_d(lo.get(), ARF_RND_FLOOR) + 0.0,
                  arf_get_d(hi.get(), ARF_RND_CEIL) + 0.0};
}

}  // namespace regulus::detail
