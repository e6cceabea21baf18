// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <cstring>

#include "same.hpp"
#include "slider.hpp"

int main() {
  slider::Checker checker;
  const auto report = checker.check(slider::kLower, slider::kUpper);
  const bool same = std::strcmp(slider_best_kernel()->identity, same_best_kernel()->identity) == 0;
  std::printf("%d %s\n", report.verdict, same ? "the same kernel" : "another kernel");
}
