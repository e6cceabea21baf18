// SPDX-License-Identifier: GPL-3.0-or-later
// Answers exact questions about intervals of doubles, without any tolerance.
#pragma once

#include <arb.h>
#include <cln/rational.h>

#include <cmath>

#include "codegen/kernel/program/ball.hpp"
#include "codegen/kernel/program/rational_bounds.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail::test {

/// Returns true if value ∈ x.
inline bool contains_exactly(const Interval& x, const cln::cl_RA& value) {
  const bool above = x.lo == -kInfinity || exact_rational(x.lo) <= value;
  const bool below = x.hi == kInfinity || value <= exact_rational(x.hi);
  return above && below;
}

/// Returns false iff the number in the ball is certainly outside x. The ball is narrower than any
/// double by hundreds of bits, so "possibly" only concerns values on a bound.
inline bool possibly_contains(const Interval& x, const Ball& ball) {
  const Ball lo(std::isfinite(x.lo) ? x.lo : 0.0);
  const Ball hi(std::isfinite(x.hi) ? x.hi : 0.0);
  const bool below = std::isfinite(x.lo) && arb_lt(ball.get(), lo.get());
  const bool above = std::isfinite(x.hi) && arb_gt(ball.get(), hi.get());
  return !below && !above;
}

}  // namespace regulus::detail::test
