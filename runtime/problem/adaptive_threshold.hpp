// SPDX-License-Identifier: Apache-2.0
// A costly test is tried up to a threshold that it learns from its own results.
#pragma once

#include <algorithm>
#include <cstddef>

#include "runtime/regularity/lanes.hpp"

namespace regulus {

/// What came of trying a test at some distance from where it surely succeeds.
struct TrialOutcome {
  double distance;
  bool certified;
};

/// Up to where a test has been paying. Its own result is the measure: where it certified, a little
/// further is worth a try; where it failed, the threshold comes closer. Boxes below it are about as
/// likely to be certified as not, or more.
class AdaptiveThreshold {
 public:
  AdaptiveThreshold() = default;
  explicit AdaptiveThreshold(double value) noexcept : value_(value) {}

  [[nodiscard]] double value() const noexcept { return value_; }
  [[nodiscard]] bool worth_trying(double distance) const noexcept { return distance < value_; }
  void learn(TrialOutcome trial) noexcept {
    if (trial.certified)
      value_ = std::max(value_, trial.distance + kStep);
    else if (trial.distance < value_)
      value_ -= kRetreat * (value_ - trial.distance);
  }

 private:
  static constexpr double kStep = 0.01, kRetreat = 0.25;
  double value_ = 1.1;
};

/// How much to try on the boxes of one batch, and what came of it. The threshold stays as it is
/// while boxes are decided and learns afterwards, in the order of the boxes: so that what is tried
/// does not depend on which batch a thread came to first.
struct TestBudget {
  LaneMask anyway = 0;  ///< lanes in which every test is to be tried
  AdaptiveThreshold threshold;
  std::size_t trials = 0;
  TrialOutcome trial[kLanes];

  void note(TrialOutcome result) noexcept {
    if (trials < kLanes) trial[trials++] = result;
  }
};

}  // namespace regulus
