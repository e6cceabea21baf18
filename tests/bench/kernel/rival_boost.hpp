// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/numeric/interval.hpp>

#include "tests/bench/kernel/operator_arithmetic.hpp"
#include "tests/bench/kernel/straight_rival.hpp"

namespace regulus::detail::bench {

/// The rounding of Boost's default, rounded_math<double>, plus the sine and cosine it lacks.
using BoostRounding = boost::numeric::interval_lib::rounded_transc_opp<double>;

/// Boost.Interval with some policies. If the operations do not set and restore the rounding mode
/// themselves, `ScopeType` does so around all of them.
template <class BoostInterval, class ScopeType>
struct BoostArithmetic : OperatorArithmetic<BoostInterval> {
  using Scope = ScopeType;
  static void from(Interval x, BoostInterval& y) { y = BoostInterval(x.lo, x.hi); }
  static Interval to(const BoostInterval& x) { return {x.lower(), x.upper()}; }
};

}  // namespace regulus::detail::bench
