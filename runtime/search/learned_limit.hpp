// SPDX-License-Identifier: Apache-2.0
// Where a dear test is worth trying, learnt from its own results.
#pragma once

#include <algorithm>
#include <cstddef>

#include "regulus/regularity/lanes.hpp"

namespace regulus {

/// What came of trying a test at some distance from where it surely succeeds.
struct Trial {
  double distance;
  bool certified;
};

/// Up to where a test has been paying. Its own result is the measure: where it certified, a little
/// further is worth a try; where it failed, the limit comes closer. Boxes below it are about as
/// likely to be certified as not, or more.
class LearnedLimit {
 public:
  LearnedLimit() = default;
  explicit LearnedLimit(double limit) noexcept : limit_(limit) {}

  [[nodiscard]] double value() const noexcept { return limit_; }
  [[nodiscard]] bool worth_trying(double distance) const noexcept { return distance < limit_; }
  void learn(Trial trial) noexcept {
    if (trial.certified)
      limit_ = std::max(limit_, trial.distance + kStep);
    else if (trial.distance < limit_)
      limit_ -= kRetreat * (limit_ - trial.distance);
  }

 private:
  static constexpr double kStep = 0.01, kRetreat = 0.25;
  double limit_ = 1.1;
};

/// How much to try on the boxes of one batch, and what came of it. The limit stays as it is while
/// boxes are decided and learns afterwards, in the order of the boxes: so that what is tried does
/// not depend on which batch a thread came to first.
struct Effort {
  LaneMask anyway = 0;  ///< lanes in which every test is to be tried
  LearnedLimit limit;
  std::size_t trials = 0;
  Trial trial[kLanes];

  void note(Trial result) noexcept {
    if (trials < kLanes) trial[trials++] = result;
  }
};

}  // namespace regulus
