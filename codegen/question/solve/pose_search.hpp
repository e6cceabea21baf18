// SPDX-License-Identifier: GPL-3.0-or-later
// All poses of a platform on six legs, by branch and prune over all rotations.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "codegen/question/solve/root_search.hpp"
#include "runtime/solutions/gough_poses.hpp"
#include "runtime/solutions/pose_equations.hpp"

namespace regulus::detail {

/// Returns the systems of a search of one chart, which has the number of the chart.
///
/// Requires  the equations exist.
[[nodiscard]] RootSystems systems_of_chart(std::shared_ptr<const PoseEquations> equations,
                                           int chart);

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

/// Where poses are while lengths and anchors are anywhere in a set.
struct PoseTubes {
  /// By pose: encloses where it is; nullopt: it may meet another one, or vanish.
  std::vector<std::optional<GoughPose>> tubes;
  bool are_all = false;         ///< no legs of the set have other poses
  std::vector<GoughPose> open;  ///< boxes that may hold singular poses of some legs of the set
  bool is_searched = true;
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// The equations that are searched while poses are followed from the legs `at` to all of `legs`.
struct FollowedEquations {
  FollowedEquations(const GoughLegs& at, const GoughLegs& legs);

  PoseEquations first, all;
};
/// Returns the systems of such a search of one chart.
///
/// Requires  both equations exist.
[[nodiscard]] RootSystems systems_of_chart(std::shared_ptr<const FollowedEquations> equations,
                                           int chart);

/// Follows all poses of some legs over the set of all legs that are enclosed.
///
/// Requires  `at`: enclosures of one platform in the set `legs`; `poses`: all poses of it.
/// Ensures   a pose with a tube moves on without a jump, within its tube, as the legs change within the set, and is
///           regular. If are_all: all have tubes, and each platform of the set has as many poses as `at`.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] PoseTubes follow_poses(const GoughLegs& at, const GoughLegs& legs,
                                     const std::vector<GoughPose>& poses, RootSettings settings,
                                     Observer* progress);

}  // namespace regulus::detail
