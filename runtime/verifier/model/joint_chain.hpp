// SPDX-License-Identifier: Apache-2.0
// [serial]: the joints of an arm, one after the other, as a model file places them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

/// A joint that moves.
struct ChainJoint {
  bool slides = false;
  PlacementNodes origin{};  ///< of its frame in that of the joint before, all joints at 0
  VectorNodes axis{};       ///< through the origin of its frame; of length 1
  std::size_t column = 0;   ///< of the joint, or of the one that it follows
  bool follows = false;     ///< another joint
  NodeId rate = kNoNode;    ///< its speed at unit speed of the column's joint
  NodeId value = kNoNode;
  NodeId offset = kNoNode;      ///< the same while the column's joint is at 0
  NodeId free_value = kNoNode;  ///< the same if a motion gives its pose parameter no value,
  NodeId free_pose = kNoNode;   ///< but this
};

/// A joint that follows no other.
struct ChainName {
  std::string name;
  bool slides = false;
  std::string range;  ///< its place in the file; "": it has none
};

/// Returns the joints that follow no other, in their order: the pose parameters.
[[nodiscard]] std::vector<ChainName> chain_names(const WrittenValues& values);

/// Returns true if numbers of angles are degrees.
[[nodiscard]] bool is_arm_in_degrees(const WrittenValues& values);

/// Returns the place of a joint's frame, for messages.
[[nodiscard]] FilePlace place_of_joint(const WrittenValues& values, const std::string& name);

[[nodiscard]] bool depends_on_variables(const Graph& graph, NodeId node);

/// The joints that move, and the frame of the tool in that of the last.
struct ReadArm {
  std::vector<ChainJoint> joints;
  PlacementNodes tool{};
};
/// Does as read_chain does. The tool has no tolerance.
[[nodiscard]] ReadArm read_arm(SectionComparer& comparer);

/// Reads every joint that moves; compares every length and angle that has a tolerance with the
/// certificate's. Throws Unfinished for a table that it does not understand.
[[nodiscard]] std::vector<ChainJoint> read_chain(SectionComparer& comparer);

}  // namespace regulus::verifier
