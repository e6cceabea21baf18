// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml wide_15 -o generated/robot_1_wide_15
// Model            robot 1
// Motion           wide_15
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         de081fe8ecfe9551ff46dc94799456056dbf955ce31217c440bb91dc08d8fce7
// Flags            -std=c++20 -O2 -frounding-math -ffp-contract=off -DREGULUS_ISA_AVX512 -mavx512f
//                  -mavx512dq -mprefer-vector-width=512
#define regulus_self_test robot_1_wide_15_self_test_avx512
#include "runtime/kernel/self_test_program.hpp"
#define robot_1_wide_15_kernel robot_1_wide_15_kernel_avx512
#include "robot_1_wide_15_kernel.inc"
