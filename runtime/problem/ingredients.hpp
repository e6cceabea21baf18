// SPDX-License-Identifier: Apache-2.0
// Parts of the search that can be switched off one by one, to see the effect of each.
#pragma once

namespace regulus {

/// All are on by default. Without one of them a search decides less, or takes longer. Its results
/// are proved all the same, since each part only adds a bound, a test or a place to look.
struct Ingredients {
  // Tests of method auto.
  bool natural = true;       ///< on K·A as rewritten
  bool mean_value = true;    ///< on its mean-value form
  bool second_order = true;  ///< on its expansion (runtime/regularity/second_order.hpp)

  // Parts of that expansion.
  bool moving = true;    ///< K(t) and w_k(t) move with the pose; else D_p = g_kp = 0
  bool rows = true;      ///< quantities that touch one row only are treated by that row
  bool orthants = true;  ///< direction by direction, where the test on T fails narrowly
  bool balls = true;     ///< coordinates of a point in a ball are bounded by their Euclidean norm

  // Places to look for a singularity.
  bool midpoints = true;  ///< at the midpoints of boxes
  bool corners = true;    ///< at corners of the variety
  bool descents = true;   ///< downhill from boxes

  bool stall = true;  ///< give up on poses at which the uncertainty alone defeats the tests

  friend constexpr bool operator==(const Ingredients&, const Ingredients&) = default;
};

}  // namespace regulus
