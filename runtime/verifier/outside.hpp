// SPDX-License-Identifier: Apache-2.0
// Which boxes and points are in the variety.
#pragma once

#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {

/// The answer of a test of a claim about a box.
enum class BoxAnswer {
  kOutside,  ///< no point of the box is in the variety
  kProved,
  kOpen,  ///< not shown
};

/// Shows that no point of a box is in the variety.
class Outside {
 public:
  /// Both must outlive this object.
  Outside(const Question& question, const Variety& variety);

  /// Ensures   true only if a constraint is positive, or the points are beyond a ball, all over the
  ///           box.
  [[nodiscard]] bool covers(const Box& box);

 private:
  [[nodiscard]] bool is_beyond(const BallOfVariables& ball, double reach, const Box& box) const;

  const Question& q_;
  const Variety& variety_;
  Evaluation motion_;
};

/// The middle of a box: a double of each range within the box. If there is none, the box's whole
/// interval.
struct Middle {
  Box point;
  std::vector<double> radius;  ///< of the box about it; 0 for a whole interval
};

/// Rounding  `radius` upward.
void place_middle(const Variety& variety, const Box& box, Middle& middle);

/// Returns true only if the point is certainly in the variety.
[[nodiscard]] bool is_certain_point(const Question& question, const Variety& variety,
                                    const Box& point);

/// Returns all the roots of several lists.
[[nodiscard]] std::vector<NodeId> join(std::initializer_list<const std::vector<NodeId>*> lists);

/// Returns the variable of the greatest impact that can be split; if no impact is positive, that of
/// the widest part of its range; nullopt if none can be split.
[[nodiscard]] std::optional<std::size_t> variable_of_impact(const Variety& variety, const Box& box,
                                                            const std::vector<double>& impact);

/// Splits variable k of a box at its middle.
[[nodiscard]] std::pair<Box, Box> halves(const Box& box, std::size_t k);

}  // namespace regulus::verifier
