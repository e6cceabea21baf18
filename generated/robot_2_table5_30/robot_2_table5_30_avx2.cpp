// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_2.toml table5_30 -o generated/robot_2_table5_30
// Model            robot 2
// Motion           table5_30
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         5913990e10fa4cdf9681a8d8ef88cecd6c637479ebced5bd8f12d592cc5dc50b
// Flags            -std=c++20 -O2 -frounding-math -ffp-contract=off -DREGULUS_ISA_AVX2 -mavx2 -mfma
#define regulus_self_test robot_2_table5_30_self_test_avx2
#include "runtime/kernel/self_test_program.hpp"
#define robot_2_table5_30_kernel robot_2_table5_30_kernel_avx2
#include "robot_2_table5_30_kernel.inc"
