// SPDX-License-Identifier: Apache-2.0
// The set that a claim is about, bounded by doubles from inside and outside.
#pragma once

#include <optional>
#include <vector>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Every point of the set lies in `outer`. Every point of `inner` that is within the balls and the
/// constraints is a point of the set.
struct Variety {
  Box outer;
  std::vector<std::optional<Interval>> inner;  ///< nullopt: no double is certain to be in the range
  std::vector<bool> exact;                     ///< true if `inner` has every double of the range
  /// For each ball, an upper bound of the Euclidean distance of its points from the doubles in the
  /// middles of `outer`.
  std::vector<double> reach;
  Interval alpha;
};

/// Also finds the question's `ends`. Throws Rejection if a range is empty, or if a spread or the
/// threshold is negative; Unfinished if one of them has no certain value.
[[nodiscard]] Variety enclose_variety(Question& question);

/// Returns true only if every point with these coordinates is certainly within the ranges and the
/// balls. A coordinate without an inner range means its one value.
[[nodiscard]] bool certain_inside(const Question& question, const Variety& variety,
                                  const Box& point);

/// Returns true only if a coordinate is certainly outside its range, or the point outside a ball.
[[nodiscard]] bool certain_outside(const Question& question, const Variety& variety,
                                   const Box& point);

}  // namespace regulus::verifier
