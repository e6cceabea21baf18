// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_2.toml table5_30 -o generated/robot_2_table5_30
// Model            robot 2
// Motion           table5_30
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         5913990e10fa4cdf9681a8d8ef88cecd6c637479ebced5bd8f12d592cc5dc50b
//
// REGULUS_CHECK_NO_SINGULARITY means: for every value of the motion parameters within the bounds,
// the full 6×6 matrix of the model is defined and has full rank.
// Uncertain: nothing; geometry and control are exact.
#ifndef REGULUS_GENERATED_robot_2_table5_30_H
#define REGULUS_GENERATED_robot_2_table5_30_H

#include "runtime/embedded/checker.h"

#ifdef __cplusplus
extern "C" {
#endif

// A value of each motion parameter, or one bound of each.
typedef struct robot_2_table5_30_parameters {
  double x;  // x in [-200, 200] cm
  double y;  // y in [-200, 200] cm
  double z;  // z in [2800, 3200] cm
  double psi;  // psi in [-0.523599, 0.523599] rad
  double theta;  // theta in [-0.523599, 0.523599] rad
  double phi;  // phi in [-0.523599, 0.523599] rad
} robot_2_table5_30_parameters;

// Their ranges, outward: pieces lie between them.
extern const robot_2_table5_30_parameters robot_2_table5_30_lower, robot_2_table5_30_upper;

// As regulus_checker_new, with the kernel for the best instruction set of this processor, after a
// test that it rounds outward here.
regulus_checker* robot_2_table5_30_checker_new(unsigned max_boxes, char* fault, size_t fault_size);

// As regulus_check: the piece between two bounds of each motion parameter, or one pose with lower =
// upper.
regulus_check_verdict robot_2_table5_30_check(regulus_checker* checker,
    const robot_2_table5_30_parameters* lower, const robot_2_table5_30_parameters* upper,
    regulus_check_report* report);

// The kernel itself, and its instruction set: avx512, avx2 or portable.
const regulus_kernel* robot_2_table5_30_best_kernel(void);
const char* robot_2_table5_30_isa(void);

#ifdef __cplusplus
}
#endif

#endif
