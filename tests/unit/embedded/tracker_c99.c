/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tracker.h is C99, and a C program can use it: legs along three axes, so that a shift is known. */
#include <math.h>
#include <stdio.h>

#include "runtime/embedded/tracker.h"

int main(void) {
  /* Two legs along each axis, to opposite sides of a cube. */
  const regulus_platform robot = {
      {{9, 1, 0}, {9, -1, 0}, {0, 9, 1}, {0, 9, -1}, {1, 0, 9}, {-1, 0, 9}},
      {{1, 1, 0}, {1, -1, 0}, {0, 1, 1}, {0, 1, -1}, {1, 0, 1}, {-1, 0, 1}},
      {0},
      {0}};
  const regulus_pose last = {{0, 0, 0}, {1, 0, 0, 0}};
  const double shift[3] = {0.01, -0.02, 0.015}, error[6] = {1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4};
  double length[6];
  for (int i = 0; i < 6; ++i) {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double gap = robot.platform[i][k] + shift[k] - robot.base[i][k];
      square += gap * gap;
    }
    length[i] = sqrt(square);
  }
  regulus_track_report report;
  const int is_one = regulus_track(&robot, &last, length, error, &report) == REGULUS_TRACK_ONE_POSE;
  double gap = 0;
  for (int k = 0; k < 3; ++k) gap = fmax(gap, fabs(report.pose.position[k] - shift[k]));
  printf("%d %g: error %g and %g rad, the only one within %g and %g rad, %u tests\n", is_one, gap,
         report.distance_error, report.angle_error, report.distance_radius, report.angle_radius,
         report.tests);
  return is_one && gap <= report.distance_error && report.distance_error < 1e-3 ? 0 : 1;
}
