// SPDX-License-Identifier: Apache-2.0
// The set that a claim is about, in doubles from both sides.
#pragma once

#include <optional>
#include <vector>

#include "runtime/certificate/verifier/evaluation.hpp"
#include "runtime/certificate/verifier/question.hpp"

namespace regulus::verifier {

/// Every point of the set lies in `outer`; every point of `inner`, within the balls and the
/// constraints, is a point of the set.
struct Variety {
  Box outer;
  std::vector<std::optional<Interval>> inner;  ///< nullopt: no double is certain to be in the range
  std::vector<bool> exact;                     ///< whether `inner` holds every double of the range
  /// Of each ball: an upper bound of the Euclidean distance of its points from the doubles in the
  /// middles of `outer`.
  std::vector<double> reach;
  Interval alpha;
};

/// Also finds the question's `ends`. Throws Rejection when a range is empty, a spread or the
/// threshold negative; Unfinished when one of them has no certain value.
[[nodiscard]] Variety enclose_variety(Question& question);

/// Whether every point with these coordinates is certainly within the ranges and the balls, where a
/// coordinate without an inner range stands for its one value.
[[nodiscard]] bool certain_inside(const Question& question, const Variety& variety,
                                  const Box& point);

/// Whether some coordinate is certainly beyond its range, or the point beyond a ball.
[[nodiscard]] bool certain_outside(const Question& question, const Variety& variety,
                                   const Box& point);

}  // namespace regulus::verifier
