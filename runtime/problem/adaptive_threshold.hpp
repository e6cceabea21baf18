// SPDX-License-Identifier: Apache-2.0
// The limit up to which a costly test is tried; it is learned from the results of the test.
#pragma once

#include <algorithm>
#include <cstddef>

#include "runtime/regularity/lanes.hpp"

namespace regulus {

/// The outcome of trying a test at some distance from a case in which it surely succeeds.
struct TrialOutcome {
  double distance;
  bool certified;
};

/// The distance up to which a test has been useful. Its own results are the measure: where it
/// certified, a slightly larger distance is tried; where it failed, the threshold decreases. Boxes
/// below it are certified at least about as often as not.
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

/// How much to try on the boxes of one batch, and the outcomes. While boxes are decided, the
/// threshold does not change. It learns afterwards, in the order of the boxes. So the tests that
/// are tried do not depend on the order in which threads reach the batches.
struct TestBudget {
  LaneMask anyway = 0;  ///< lanes in which every test must be tried
  LaneMask last = 0;    ///< lanes that are not split any more: a test may take very long
  AdaptiveThreshold threshold;
  std::size_t trials = 0;
  TrialOutcome trial[kLanes];

  void note(TrialOutcome result) noexcept {
    if (trials < kLanes) trial[trials++] = result;
  }
};

}  // namespace regulus
