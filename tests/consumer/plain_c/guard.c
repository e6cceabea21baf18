/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "arm.h"

int main(void) {
  char fault[120];
  regulus_checker* checker = arm_checker_new(256, fault, sizeof fault);
  if (!checker) return fprintf(stderr, "%s\n", fault), 1;
  const arm_parameters from = {-2, 13, -0.25}, to = {4, 18, 0.05};
  const int safe = arm_check(checker, &from, &to, NULL) == REGULUS_CHECK_NO_SINGULARITY;
  puts(safe ? "go" : "stop");
  regulus_checker_free(checker);
  return 0;
}
