// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/measure/rounds.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail::bench {
namespace {

double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

double seconds_of(const Contender& contender, std::size_t passes, double (*clock)()) {
  const double start = clock();
  for (std::size_t i = 0; i < passes; ++i) contender.pass();
  return (clock() - start) / static_cast<double>(passes);
}

/// Returns how many passes fill a slice. The trial passes warm the caches, too.
std::size_t passes_for(const Contender& contender, const RoundOptions& options) {
  constexpr std::size_t kMost = 1u << 24;
  std::size_t passes = 1;
  while (passes < kMost) {
    const double seconds =
        seconds_of(contender, passes, options.clock) * static_cast<double>(passes);
    if (seconds >= options.slice) break;
    passes *= seconds < options.slice / 8 ? 8 : 2;
  }
  return passes;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

std::vector<Timing> compare(std::span<const Contender> contenders, const RoundOptions& options) {
  const std::size_t n = contenders.size();
  std::vector<std::size_t> passes;
  for (const Contender& contender : contenders) passes.push_back(passes_for(contender, options));

  const auto time = [&](std::size_t i) {
    return seconds_of(contenders[i], passes[i], options.clock) / contenders[i].units;
  };
  std::vector<std::vector<double>> seconds(n), ratios(n);
  for (std::size_t round = 0; round < options.rounds; ++round) {
    double before = time(0);
    for (std::size_t i = 1; i < n; ++i) {
      seconds[0].push_back(before);
      seconds[i].push_back(time(i));
      const double after = time(0);
      ratios[i].push_back(seconds[i].back() / (0.5 * (before + after)));
      before = after;
    }
    seconds[0].push_back(before);
  }
  ratios[0] = {1.0};

  std::vector<Timing> timings;
  for (std::size_t i = 0; i < n; ++i)
    timings.push_back({spread_of(std::move(seconds[i])), spread_of(std::move(ratios[i]))});
  return timings;
}

}  // namespace regulus::detail::bench
