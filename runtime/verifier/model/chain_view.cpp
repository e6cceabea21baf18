// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/chain_view.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace regulus::verifier {

std::vector<std::size_t> ChainView::links() const {
  std::vector<std::size_t> links(chain_.size() + 1);
  std::iota(links.begin(), links.end(), std::size_t{0});
  const long twice_middle = long(chain_.size());
  std::ranges::stable_sort(
      links, {}, [&](std::size_t link) { return std::labs(2 * long(link) - twice_middle); });
  return links;
}

PlacementNodes ChainView::motion(const ChainJoint& joint) {
  if (joint.slides) return {algebra_.identity(), algebra_.scaled(joint.value, joint.axis)};
  return {algebra_.turn(joint.axis, joint.value), algebra_.zero()};
}

/// Returns the frame of a joint, before its own motion, in that of a link.
PlacementNodes ChainView::from_link(std::size_t link, std::size_t joint) {
  PlacementNodes T = algebra_.at_rest();
  for (std::size_t j = link; j < joint; ++j)
    T = algebra_.product(T, algebra_.product(chain_[j].origin, motion(chain_[j])));
  if (joint >= link) return algebra_.product(T, chain_[joint].origin);
  // The motion of the joint itself changes neither its axis nor, along it, a point of the axis.
  for (std::size_t j = joint + 1; j < link; ++j)
    T = algebra_.product(T, algebra_.product(chain_[j].origin, motion(chain_[j])));
  T = algebra_.inverse(T);
  if (chain_[joint].slides) return {T.R, algebra_.zero()};
  return T;
}

/// A joint turns about, or slides along, an axis through a point.
TwistNodes ChainView::twist(const ChainJoint& joint, const VectorNodes& axis,
                            const VectorNodes& point) {
  const VectorNodes rate = algebra_.scaled(joint.rate, axis);
  if (joint.slides) return {rate, algebra_.zero()};
  return {algebra_.cross(point, rate), rate};
}

TwistColumns ChainView::twists(std::size_t link) {
  TwistColumns result;
  for (std::size_t j = 0; j < chain_.size(); ++j) {
    const PlacementNodes frame = from_link(link, j);
    result.push_back(twist(chain_[j], algebra_.product(frame.R, chain_[j].axis), frame.p));
  }
  return result;
}

TwistColumns ChainView::with_followers(const TwistColumns& twists) {
  TwistColumns columns(columns_, {algebra_.zero(), algebra_.zero()});
  for (std::size_t j = 0; j < chain_.size(); ++j) {
    TwistNodes& column = columns[chain_[j].column];
    column = {algebra_.sum(column.velocity, twists[j].velocity),
              algebra_.sum(column.spin, twists[j].spin)};
  }
  return columns;
}

TwistColumns ChainView::moved_to(const TwistColumns& twists, const VectorNodes& point) {
  TwistColumns columns = twists;
  for (TwistNodes& t : columns)
    t.velocity = algebra_.sum(t.velocity, algebra_.cross(t.spin, point));
  return columns;
}

bool ChainView::is_zero(NodeId node) {
  return equality(comparer_.question(), node, algebra_.number(0)) == Equality::kEqual;
}

/// An axis a through 0, and b through p: s·a = p + t·b.
std::optional<ChainView::Meeting> ChainView::meeting(std::size_t first) {
  const ChainJoint &one = chain_[first], &other = chain_[first + 1];
  if (one.slides || other.slides) return std::nullopt;
  const VectorNodes &a = one.axis, &p = other.origin.p;
  const VectorNodes b = algebra_.product(other.origin.R, other.axis);
  const VectorNodes normal = algebra_.cross(a, b);
  const NodeId square = algebra_.dot(normal, normal);
  if (equality(comparer_.question(), square, algebra_.number(0)) != Equality::kDifferent)
    return std::nullopt;
  if (!is_zero(algebra_.dot(p, normal))) return std::nullopt;
  const auto along = [&](const VectorNodes& across) {
    return algebra_.quotient(algebra_.dot(algebra_.cross(p, across), normal), square);
  };
  return Meeting{along(b), along(a)};
}

std::vector<VectorNodes> ChainView::points(std::size_t link) {
  std::vector<VectorNodes> points = {algebra_.zero()};
  // The origin of this frame is on the axis of joint link − 1, unless that joint slides.
  if (link > 1)
    if (const auto m = meeting(link - 2))
      points.push_back(algebra_.scaled(m->along_second, chain_[link - 1].axis));
  if (link == chain_.size()) return points;
  const PlacementNodes& next = chain_[link].origin;
  points.push_back(next.p);
  if (link > 0)
    if (const auto m = meeting(link - 1))
      points.push_back(algebra_.scaled(m->along_first, chain_[link - 1].axis));
  if (link + 1 < chain_.size())
    if (const auto m = meeting(link)) {
      const VectorNodes inner = algebra_.scaled(m->along_first, chain_[link].axis);
      points.push_back(algebra_.sum(algebra_.product(next.R, inner), next.p));
    }
  return points;
}

}  // namespace regulus::verifier
