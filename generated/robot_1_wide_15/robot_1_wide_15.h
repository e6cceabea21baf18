// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml wide_15 -o generated/robot_1_wide_15
// Model            robot 1
// Motion           wide_15
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         de081fe8ecfe9551ff46dc94799456056dbf955ce31217c440bb91dc08d8fce7
//
// REGULUS_CHECK_NO_SINGULARITY means: for every value of the motion parameters within the bounds,
// the full 6×6 matrix of the model is defined and has full rank.
// Uncertain: nothing; geometry and control are exact.
#ifndef REGULUS_GENERATED_robot_1_wide_15_H
#define REGULUS_GENERATED_robot_1_wide_15_H

#include "runtime/embedded/checker.h"

#ifdef __cplusplus
extern "C" {
#endif

// A value of each motion parameter, or one bound of each.
typedef struct robot_1_wide_15_parameters {
  double x;  // x in [-15, 15] cm
  double y;  // y in [-15, 15] cm
  double z;  // z in [45, 50] cm
  double psi;  // psi in [-0.261799, 0.261799] rad
  double theta;  // theta in [-0.261799, 0.261799] rad
  double phi;  // phi in [-0.261799, 0.261799] rad
} robot_1_wide_15_parameters;

// Their ranges, outward: pieces lie between them.
extern const robot_1_wide_15_parameters robot_1_wide_15_lower, robot_1_wide_15_upper;

// As regulus_checker_new, with the kernel for the best instruction set of this processor, after a
// test that it rounds outward here.
regulus_checker* robot_1_wide_15_checker_new(unsigned max_boxes, char* fault, size_t fault_size);

// As regulus_check: the piece between two bounds of each motion parameter, or one pose with lower =
// upper.
regulus_check_verdict robot_1_wide_15_check(regulus_checker* checker,
    const robot_1_wide_15_parameters* lower, const robot_1_wide_15_parameters* upper,
    regulus_check_report* report);

// The kernel itself, and its instruction set: avx512, avx2 or portable.
const regulus_kernel* robot_1_wide_15_best_kernel(void);
const char* robot_1_wide_15_isa(void);

#ifdef __cplusplus
}
#endif

#endif
