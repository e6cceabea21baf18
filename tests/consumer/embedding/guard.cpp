// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "arm.hpp"

int main() {
  arm::Checker checker;
  const auto near_home = checker.check({-2, 13, -0.25}, {4, 18, 0.05});
  const auto turned = checker.check({-2, 13, -0.25}, {4, 18, 1});
  std::printf("near home: %s\n", near_home.verdict == REGULUS_CHECK_NO_SINGULARITY ? "go" : "stop");
  std::printf("turned:    %s\n", turned.verdict == REGULUS_CHECK_NO_SINGULARITY ? "go" : "stop");
}
