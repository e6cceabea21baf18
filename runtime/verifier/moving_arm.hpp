// SPDX-License-Identifier: Apache-2.0
// The joints of an arm that move, and what moves them, as the lines of a certificate state them.
#pragma once

#include <optional>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/question.hpp"
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

inline constexpr std::size_t kJointsOfArm = 6;
/// Of an arm that turns about one direction alone.
inline constexpr std::size_t kJointsOfLevelArm = 4;
/// Free joints that come back with all that follows them come back within so many turns.
inline constexpr long kMostTurns = 64;

/// A joint whose value is `factor` times that of a free joint, its leader, which may be itself.
struct MovingJoint {
  PlacementNodes before{};  ///< its frame, seen from the one that the joint before moves
  VectorNodes axis{};
  bool slides = false;
  std::size_t leader = 0;  ///< a number among the free joints
  NodeId factor = kNoNode;
};

struct FreeJoint {
  bool slides = false;
  bool is_alone = true;  ///< no other joint moves with it
  /// After so many turns all that it moves is as before; 0: it slides, or no such number is known.
  long turns = 1;
  NodeId lower = kNoNode, upper = kNoNode;  ///< the ends of its range; kNoNode: it has none
};

struct MovingArm {
  std::vector<MovingJoint> joints;
  std::vector<FreeJoint> free;
  PlacementNodes target{};  ///< where the last joint that moves is to be
  /// Of an arm of four free joints: each of its orientations is one of them turned about this direction.
  std::optional<VectorNodes> direction{};
  bool is_turned_away = false;  ///< the target has another orientation than these

  /// Returns the movement of a joint by a value of its own.
  [[nodiscard]] PlacementNodes moved(GraphAlgebra& algebra, const MovingJoint& joint,
                                     NodeId value) const;
  /// Returns the frame that the last joint moves, by the values of the free joints.
  [[nodiscard]] PlacementNodes end(GraphAlgebra& algebra, const std::vector<NodeId>& values) const;
};

/// Joints that keep their values become parts of the frames behind them, and so do offsets.
///
/// Requires  question.solutions has an arm.
/// `places`: enclose the uncertain quantities.
/// Throws    Unfinished if a number of the arm has no certain value, if a frame is not shown to be a rotation, or if an
///           arm of four free joints is not shown to turn about one direction.
[[nodiscard]] MovingArm read_moving_arm(Question& question, const std::vector<Ball>& places);

}  // namespace regulus::verifier
