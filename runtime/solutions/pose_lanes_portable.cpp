// SPDX-License-Identifier: Apache-2.0
#define REGULUS_POSE_LANES evaluate_poses_portable
#include "runtime/solutions/pose_lanes.hpp"
