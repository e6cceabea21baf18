// SPDX-License-Identifier: GPL-3.0-or-later
// Uses two kernels side by side: each fulfils its own header, and neither replaces the other.
#include <cmath>
#include <cstdio>

#include "arm.hpp"
#include "other.hpp"

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("%s\n", what);
  ++failures;
}

template <class Checker, class Parameters>
regulus_check_verdict check(const Parameters& lower, const Parameters& upper, unsigned boxes) {
  Checker checker(boxes);
  return checker.check(lower, upper).verdict;
}

void check_arm() {
  const arm::Parameters crossed = {4, 18, 1}, home = {-2, 13, 0};
  expect(check<arm::Checker>(arm::kLower, arm::kUpper, 256) == REGULUS_CHECK_SINGULARITY,
         "the whole motion of arm crosses a singularity");
  expect(check<arm::Checker>(home, home, 1) == REGULUS_CHECK_NO_SINGULARITY, "home is regular");
  expect(check<arm::Checker>(crossed, home, 256) == REGULUS_CHECK_POSSIBLE_PROBLEM,
         "bounds in the wrong order prove nothing");
  arm::Parameters nowhere = home;
  nowhere.x = std::nan("");
  expect(check<arm::Checker>(nowhere, nowhere, 256) == REGULUS_CHECK_POSSIBLE_PROBLEM,
         "a NaN proves nothing");
}

void check_other() {
  using plant::arm::Checker, plant::arm::kLower, plant::arm::kUpper;
  expect(kLower.T == 0 && kUpper.T == 0.5, "RANGE is the range");
  expect(plant::arm::kAlpha >= 0.01 && plant::arm::kAlpha <= 0.01 + 1e-15, "ALPHA is rounded up");
  expect(other_best_kernel()->motion_variables == 1 && other_best_kernel()->variables > 4,
         "TOLERANCE makes quantities uncertain");
  expect(check<Checker>(kLower, kUpper, 256) == REGULUS_CHECK_NO_SINGULARITY, "the arc is regular");
  expect(
      check<Checker>(kLower, plant::arm::Parameters{0.75}, 256) == REGULUS_CHECK_POSSIBLE_PROBLEM,
      "outside the range nothing is proved");
}

}  // namespace

int main() {
  check_arm();
  check_other();
  std::printf("%d failures, %s\n", failures, arm::Checker::isa());
  return failures;
}
