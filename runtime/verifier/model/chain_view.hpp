// SPDX-License-Identifier: Apache-2.0
// The Jacobian of an arm, seen from one of its links.
#pragma once

#include <vector>

#include "runtime/verifier/model/joint_chain.hpp"

namespace regulus::verifier {

/// The twist of a body: the velocity of the point of it that is at the reference point, and its
/// angular velocity.
struct TwistNodes {
  VectorNodes velocity, spin;
};

using TwistColumns = std::vector<TwistNodes>;

class ChainView {
 public:
  /// Both must outlive this object. `columns`: the joints that follow no other.
  ChainView(SectionComparer& comparer, const std::vector<ChainJoint>& chain, std::size_t columns)
      : comparer_(comparer),
        algebra_(comparer.question().graph),
        chain_(chain),
        columns_(columns) {}

  /// Returns the links, 0 for the base, those in the middle first.
  [[nodiscard]] std::vector<std::size_t> links() const;
  /// Returns the twist of the tool for each joint of the chain in the frame of a link, its origin
  /// being the reference point, where the joint that it follows, or itself, has unit speed.
  [[nodiscard]] TwistColumns twists(std::size_t link);
  /// Returns the same twists, the reference point being `point`.
  [[nodiscard]] TwistColumns moved_to(const TwistColumns& twists, const VectorNodes& point);
  /// Returns the sums of the twists of each joint that follows no other and of its followers.
  [[nodiscard]] TwistColumns with_followers(const TwistColumns& twists);
  /// Returns points that are fixed in the frame of a link: its origin, that of the next joint, and
  /// where the axes of neighbouring joints meet.
  [[nodiscard]] std::vector<VectorNodes> points(std::size_t link);

 private:
  /// Where the axes of joint `first` and the next one meet: how far along each.
  struct Meeting {
    NodeId along_first, along_second;
  };

  [[nodiscard]] PlacementNodes motion(const ChainJoint& joint);
  [[nodiscard]] PlacementNodes from_link(std::size_t link, std::size_t joint);
  [[nodiscard]] TwistNodes twist(const ChainJoint& joint, const VectorNodes& axis,
                                 const VectorNodes& point);
  [[nodiscard]] std::optional<Meeting> meeting(std::size_t first);
  [[nodiscard]] bool is_zero(NodeId node);

  SectionComparer& comparer_;
  GraphAlgebra algebra_;
  const std::vector<ChainJoint>& chain_;
  const std::size_t columns_;
};

}  // namespace regulus::verifier
