// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the times of contenders on a machine that others use, too.
//
// A single time says little there, because the clock rate and the other programs change from second
// to second. So all contenders run in rounds, each beside the reference. The report has the median
// over the rounds of a ratio within one round.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/measure/clocks.hpp"

namespace regulus::detail::bench {

/// The median, and the quartiles as a measure of how much the values vary.
struct Spread {
  double median = 0;
  double low = 0;
  double high = 0;
};

/// Requires  at least one value.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// A piece of code to time: `pass` does `units` units of work, the same work each time.
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
  double slice = 2e-3;  ///< least time of a timing in seconds; it has as many passes as needed
  double (*clock)() = thread_seconds;
};

/// Times all contenders. The first one is the reference. In each round every contender runs between
/// two runs of the reference and is compared with their mean.
///
/// Requires  at least one contender and one round.
/// Ensures   the timings in the contenders' order; the reference has ratio 1 by definition.
[[nodiscard]] std::vector<Timing> compare(std::span<const Contender> contenders,
                                          const RoundOptions& options = {});

}  // namespace regulus::detail::bench
