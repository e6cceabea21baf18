// SPDX-License-Identifier: Apache-2.0
#define REGULUS_POSE_LANES evaluate_poses_avx512
#include "runtime/solutions/pose_lanes.hpp"
