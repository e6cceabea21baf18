// SPDX-License-Identifier: Apache-2.0
#include "runtime/interval/elementary.hpp"

#include "runtime/interval/elementary/arcsine.hpp"
#include "runtime/interval/elementary/arctangent.hpp"
#include "runtime/interval/elementary/exponential.hpp"
#include "runtime/interval/elementary/trigonometric.hpp"

namespace regulus {

using namespace detail;

namespace {

elementary::Bounds<double> bounds(Interval x) noexcept { return {x.lo, x.hi}; }
Interval interval(elementary::Bounds<double> x) noexcept { return {x.lo, x.hi}; }

Interval interval(const elementary::Partial<double>& x, bool& undefined) noexcept {
  if (!x.undefined) return interval(x.value);
  undefined = true;
  return kEntire;
}

}  // namespace

static_assert(kTrigonometricLimit == elementary::kReductionLimit);

SinCos sincos(Interval x) noexcept {
  const auto both = elementary::sin_cos_bounds(bounds(x));
  return {interval(both.sin), interval(both.cos)};
}
Interval sin(Interval x) noexcept { return sincos(x).sin; }
Interval cos(Interval x) noexcept { return sincos(x).cos; }

Interval tan(Interval x, bool& undefined) noexcept {
  return interval(elementary::tan_bounds(bounds(x)), undefined);
}
Interval asin(Interval x, bool& undefined) noexcept {
  return interval(elementary::asin_bounds(bounds(x)), undefined);
}
Interval acos(Interval x, bool& undefined) noexcept {
  return interval(elementary::acos_bounds(bounds(x)), undefined);
}
Interval atan(Interval x) noexcept { return interval(elementary::atan_bounds(bounds(x))); }
Interval atan2(Interval y, Interval x, bool& undefined) noexcept {
  return interval(elementary::atan2_bounds(bounds(y), bounds(x)), undefined);
}
Interval exp(Interval x) noexcept { return interval(elementary::exp_bounds(bounds(x))); }
Interval log(Interval x, bool& undefined) noexcept {
  return interval(elementary::log_bounds(bounds(x)), undefined);
}

Interval tan(Interval x) noexcept {
  bool undefined = false;
  return tan(x, undefined);
}
Interval asin(Interval x) noexcept {
  bool undefined = false;
  return asin(x, undefined);
}
Interval acos(Interval x) noexcept {
  bool undefined = false;
  return acos(x, undefined);
}
Interval atan2(Interval y, Interval x) noexcept {
  bool undefined = false;
  return atan2(y, x, undefined);
}
Interval log(Interval x) noexcept {
  bool undefined = false;
  return log(x, undefined);
}

}  // namespace regulus
