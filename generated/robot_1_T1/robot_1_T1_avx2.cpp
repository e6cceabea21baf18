// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml T1 -o generated/robot_1_T1
// Model            robot 1
// Motion           T1
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         58a478441814040435ff3bd6eeae807fb63e1717f38974d84b2d08c6ae339380
// Flags            -std=c++20 -O2 -frounding-math -ffp-contract=off -DREGULUS_ISA_AVX2 -mavx2 -mfma
#define regulus_self_test robot_1_T1_self_test_avx2
#include "runtime/kernel/self_test_program.hpp"
#define robot_1_T1_kernel robot_1_T1_kernel_avx2
#include "robot_1_T1_kernel.inc"
