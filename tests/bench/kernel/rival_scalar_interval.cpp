// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/operator_arithmetic.hpp"
#include "tests/bench/kernel/straight_rival.hpp"

namespace regulus::detail::bench {
namespace {

struct ScalarInterval : OperatorArithmetic<Interval> {
  using Scope = NoScope;
  static void from(Interval x, Interval& y) { y = x; }
  static Interval to(const Interval& x) { return x; }
};

}  // namespace

std::unique_ptr<Rival> make_scalar_interval(const Sample& sample) {
  return std::make_unique<StraightRival<ScalarInterval>>(sample);
}

}  // namespace regulus::detail::bench
