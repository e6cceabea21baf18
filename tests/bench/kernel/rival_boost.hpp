// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/numeric/interval.hpp>

#include "tests/bench/kernel/operator_arithmetic.hpp"
#include "tests/bench/kernel/straight_rival.hpp"

namespace regulus::bench {

/// The rounding of Boost's default, rounded_math<double>, with the sine and cosine that it lacks.
using BoostRounding = boost::numeric::interval_lib::rounded_transc_opp<double>;

/// Boost.Interval of some policies. `ScopeType` is what sets and
/// restores the rounding mode around all operations where they do not do so themselves.
template <class BoostInterval, class ScopeType>
struct BoostArithmetic : OperatorArithmetic<BoostInterval> {
  using Scope = ScopeType;
  static void from(Interval x, BoostInterval& y) { y = BoostInterval(x.lo, x.hi); }
  static Interval to(const BoostInterval& x) { return {x.lower(), x.upper()}; }
};

}  // namespace regulus::bench
