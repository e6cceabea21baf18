// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml T1 -o generated/robot_1_T1
// Model            robot 1
// Motion           T1
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         58a478441814040435ff3bd6eeae807fb63e1717f38974d84b2d08c6ae339380
//
// REGULUS_CHECK_NO_SINGULARITY means: for every value of the motion parameters within the bounds,
// the full 6×6 matrix of the model is defined and has full rank.
// Uncertain: nothing; geometry and control are exact.
#ifndef REGULUS_GENERATED_robot_1_T1_H
#define REGULUS_GENERATED_robot_1_T1_H

#include "runtime/embedded/checker.h"

#ifdef __cplusplus
extern "C" {
#endif

// A value of each motion parameter, or one bound of each.
typedef struct robot_1_T1_parameters {
  double T;  // T in [0, 1]
} robot_1_T1_parameters;

// Their ranges, outward: pieces lie between them.
extern const robot_1_T1_parameters robot_1_T1_lower, robot_1_T1_upper;

// As regulus_checker_new, with the kernel for the best instruction set of this processor, after a
// test that it rounds outward here.
regulus_checker* robot_1_T1_checker_new(unsigned max_boxes, char* fault, size_t fault_size);

// As regulus_check: the piece between two bounds of each motion parameter, or one pose with lower =
// upper.
regulus_check_verdict robot_1_T1_check(regulus_checker* checker,
    const robot_1_T1_parameters* lower, const robot_1_T1_parameters* upper,
    regulus_check_report* report);

// The kernel itself, and its instruction set: avx512, avx2 or portable.
const regulus_kernel* robot_1_T1_best_kernel(void);
const char* robot_1_T1_isa(void);

#ifdef __cplusplus
}
#endif

#endif
