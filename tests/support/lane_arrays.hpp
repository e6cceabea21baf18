// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices in the layouts of runtime/interval/lanes.hpp, and members between their bounds.
#pragma once

#include <algorithm>
#include <vector>

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

using Random = RandomSource;

inline double uniform(Random& random, double lo, double hi) { return random.between(lo, hi); }

/// Returns a double of [lo, hi]; an end in two of three cases, since extremes are there.
inline double member(Random& random, double lo, double hi) {
  const auto kind = random.next() % 3;
  if (kind == 0) return lo;
  if (kind == 1) return hi;
  return std::clamp(uniform(random, 0, 1) * (hi - lo) + lo, lo, hi);
}

/// Returns a number that is often a difficult case: 0, ±1, tiny, huge, or anything in between.
inline double awkward(Random& random) {
  switch (random.next() % 8) {
    case 0:
      return 0.0;
    case 1:
      return -0.0;
    case 2:
      return random.next() % 2 == 0 ? 1.0 : -1.0;
    case 3:
      return std::ldexp(uniform(random, -1, 1), -1060);
    case 4:
      return std::ldexp(uniform(random, -1, 1), static_cast<int>(random.next() % 200) - 100);
    default:
      return uniform(random, -3, 3);
  }
}

// These present arrays of numbers as square matrices of order n, or as vectors.
inline PointMatrix points(std::vector<double>& x, std::size_t n) {
  return PointMatrix(x.data(), n, n);
}
inline ConstPointMatrix points(const std::vector<double>& x, std::size_t n) {
  return ConstPointMatrix(x.data(), n, n);
}
inline PointVector points(std::vector<double>& x) {
  return PointVector(x.data(), x.size() / kLanes);
}
inline ConstPointVector points(const std::vector<double>& x) {
  return ConstPointVector(x.data(), x.size() / kLanes);
}
inline ConstIntervalMatrix intervals(const std::vector<double>& x, std::size_t n) {
  return ConstIntervalMatrix(x.data(), n, n);
}
inline ConstIntervalVector intervals(const std::vector<double>& x) {
  return ConstIntervalVector(x.data(), x.size() / (2 * kLanes));
}

/// Returns one lane of an array of intervals.
inline std::vector<Interval> interval_lane_of(const std::vector<double>& x, std::size_t lane) {
  std::vector<Interval> result;
  for (std::size_t e = 0; lower_at(e, lane) < x.size(); ++e)
    result.emplace_back(x[lower_at(e, lane)], x[upper_at(e, lane)]);
  return result;
}

}  // namespace regulus::detail::test
