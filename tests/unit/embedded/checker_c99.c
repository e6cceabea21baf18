/* SPDX-License-Identifier: GPL-3.0-or-later */
/* checker.h is C99, and a C program can use it. */
#include <stdio.h>

#include "runtime/embedded/checker.h"

/* A = [x] over one motion parameter x. */
static unsigned matrix(const double* boxes, const double* points, double* out,
                       const void* context) {
  (void)points;
  (void)context;
  for (int i = 0; i < 2 * REGULUS_LANES; ++i) out[i] = boxes[i];
  return 0;
}

int main(void) {
  regulus_kernel kernel = {0};
  kernel.abi = REGULUS_KERNEL_ABI;
  kernel.rounding = REGULUS_ROUND_NEAREST;
  kernel.variables = kernel.motion_variables = 1;
  kernel.rows = kernel.columns = 1;
  kernel.matrix = matrix;
  kernel.identity = "C";
  const double lower = -1.0, upper = 1.0, from = 0.25, below = -0.5;
  char fault[80];
  regulus_checker* checker =
      regulus_checker_new(&kernel, &lower, &upper, 0.0, 64, fault, sizeof fault);
  if (!checker) {
    fprintf(stderr, "%s\n", fault);
    return 1;
  }
  regulus_check_report report;
  const int safe = regulus_check(checker, &from, &upper, &report) == REGULUS_CHECK_NO_SINGULARITY;
  const int singular = regulus_check(checker, &below, &upper, &report) == REGULUS_CHECK_SINGULARITY;
  printf("%d %d %u\n", safe, singular, report.places);
  regulus_checker_free(checker);
  return safe && singular && report.places == 2 ? 0 : 1;
}
