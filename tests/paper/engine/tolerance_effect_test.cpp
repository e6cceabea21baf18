// SPDX-License-Identifier: GPL-3.0-or-later
// §IV: the effect of anchor tolerances on the determinant of robot 1 at single poses. The paper has
// 25–40 % under "±0.1": ranges of width 0.1 give this; with ±0.1 it varies by 47–73 %.
#include "tests/paper/tables/tolerance_effect.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::test {
namespace {

TEST(ToleranceEffect, ChangesTheDeterminantByAQuarterToTwoFifths) {
  const ToleranceEffect effect;
  for (const Pose& pose : kPoses) {
    const double value = std::fabs(effect.nominal(pose));
    for (const int sense : {-1, 1}) {
      const double change = std::fabs(effect.extreme(pose, 0.05, sense) / value - 1);
      EXPECT_GE(change, 0.25);
      EXPECT_LE(change, 0.40);
      EXPECT_GE(std::fabs(effect.extreme(pose, 0.1, sense) / value - 1), 0.47);
    }
  }
}

TEST(ToleranceEffect, IntervalEvaluationIsFarWiderThanTheExtremes) {
  const ToleranceEffect effect;
  for (const Pose& pose : kPoses) {
    const double most = effect.extreme(pose, 0.1, 1), least = effect.extreme(pose, 0.1, -1);
    const Interval enclosure = effect.determinant(pose, 0.1, nullptr);
    const double sign = effect.nominal(pose) > 0 ? 1 : -1;
    EXPECT_LE(enclosure.lo, std::min(sign * most, sign * least));
    EXPECT_GE(enclosure.hi, std::max(sign * most, sign * least));
    EXPECT_LT(enclosure.lo * enclosure.hi, 0);  // the enclosure loses the sign, as in the paper
    EXPECT_GE(enclosure.hi - enclosure.lo, 7 * (most - least));
  }
}

}  // namespace
}  // namespace regulus::detail::test
