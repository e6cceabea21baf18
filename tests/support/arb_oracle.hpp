// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the tightest doubles around elementary functions of doubles and intervals, by Arb.
#pragma once

#include <arb.h>

#include "runtime/interval/type.hpp"

namespace regulus::detail::test {

inline constexpr slong kFirstPrecision = 96;
inline constexpr slong kLastPrecision = 3072;

class ArbOracle {
 public:
  using Unary = void (*)(arb_t, const arb_t, slong);

  ArbOracle() {
    for (auto* x : {&x_, &y_, &value_}) arb_init(*x);
    arf_init(lower_);
    arf_init(upper_);
  }
  ~ArbOracle() {
    for (auto* x : {&x_, &y_, &value_}) arb_clear(*x);
    arf_clear(lower_);
    arf_clear(upper_);
  }
  ArbOracle(const ArbOracle&) = delete;
  ArbOracle& operator=(const ArbOracle&) = delete;

  /// Ensures   [RD f(x), RU f(x)]. If no precision decides, f(x) counts as a double: no other
  ///           value of an elementary function at a double agrees with one to 3072 bits.
  Interval tight(Unary f, double x) {
    arb_set_d(x_, x);
    return settle([&](slong precision) { f(value_, x_, precision); });
  }

  Interval tight_atan2(double y, double x) {
    arb_set_d(x_, x);
    arb_set_d(y_, y);
    return settle([&](slong precision) { arb_atan2(value_, y_, x_, precision); });
  }

  /// Returns ⌊(x − offset·π/2)/(period·π/2)⌋: the number of periods up to x.
  double turns(double x, int offset, int period) {
    arb_set_d(x_, x);
    return settle([&](slong precision) {
             arb_const_pi(y_, precision);
             arb_mul_2exp_si(y_, y_, -1);
             arb_div(value_, x_, y_, precision);
             arb_sub_si(value_, value_, offset, precision);
             arb_div_si(value_, value_, period, precision);
             arb_floor(value_, value_, precision);
           })
        .lo;
  }

 private:
  template <class Evaluate>
  Interval settle(Evaluate evaluate) {
    for (slong precision = kFirstPrecision;; precision *= 2) {
      evaluate(precision);
      arb_get_interval_arf(lower_, upper_, value_, precision);
      const Interval inner{arf_get_d(lower_, ARF_RND_FLOOR), arf_get_d(upper_, ARF_RND_CEIL)};
      const double lo_of_upper = arf_get_d(upper_, ARF_RND_FLOOR);
      const double hi_of_lower = arf_get_d(lower_, ARF_RND_CEIL);
      if (inner.lo == lo_of_upper && inner.hi == hi_of_lower) return inner;
      if (precision >= kLastPrecision)
        return hi_of_lower == lo_of_upper ? Interval{hi_of_lower} : inner;
    }
  }

  arb_t x_, y_, value_;
  arf_t lower_, upper_;
};

}  // namespace regulus::detail::test
