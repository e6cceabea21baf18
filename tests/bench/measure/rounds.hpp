// SPDX-License-Identifier: GPL-3.0-or-later
// Times things against each other on a machine that others use, too.
//
// A time by itself says little there: the clock rate and the neighbours change from second to
// second. So everything is timed in rounds, one after the other, each beside the reference, and
// what is reported is the median over the rounds of a ratio within a round.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/measure/clocks.hpp"

namespace regulus::bench {

/// The median, and the quartiles as a measure of how much the values wobble.
struct Spread {
  double median = 0;
  double low = 0;
  double high = 0;
};

/// Requires  at least one value.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Something to be timed: `pass` does `units` units of work, the same work each time.
struct Contender {
  std::string name;
  double units = 1;
  std::function<void()> pass;
};

struct Timing {
  Spread seconds;  ///< of one unit
  Spread ratio;    ///< to the reference, in the same round; more is slower
};

struct RoundOptions {
  std::size_t rounds = 15;
  double slice = 2e-3;  ///< seconds of each timing at least, by as many passes as that takes
  double (*clock)() = thread_seconds;
};

/// Times all contenders. In each round every contender runs between two runs of the reference, the
/// first of them, and is compared with the mean of the two.
///
/// Requires  at least one contender and one round.
/// Ensures   the timings in the contenders' order; that of the reference has ratio 1 by definition.
[[nodiscard]] std::vector<Timing> compare(std::span<const Contender> contenders,
                                          const RoundOptions& options = {});

}  // namespace regulus::bench
