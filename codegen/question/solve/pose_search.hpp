// SPDX-License-Identifier: GPL-3.0-or-later
// All poses of a platform on six legs, by branch and prune over all rotations.
#pragma once

#include <optional>
#include <vector>

#include "codegen/question/solve/root_search.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus {

struct PoseList {
  std::vector<GoughPose> poses;  ///< pairwise different; each is regular
  std::vector<GoughPose> open;   ///< boxes that may hold others
  bool is_complete = false;      ///< there are no others
  bool is_doubtful = false;      ///< two enclosures overlap, and are not shown to be of one pose
  bool is_searched = true;       ///< false: the anchors are too special for the equations
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// Ensures   for all legs of the enclosures, each of `poses` encloses one pose, which is regular. If
///           is_complete, there is no other. The result does not depend on threads.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] PoseList search_poses(const GoughLegs& legs, RootSettings settings,
                                    Observer* progress);

}  // namespace regulus
