// SPDX-License-Identifier: Apache-2.0
#include "regulus/certificate/verifier/variety.hpp"

#include <algorithm>

namespace regulus::verifier {
namespace {

constexpr long kBits = 128;

Ball constant(const Question& q, NodeId node, const std::string& what) {
  const auto value = evaluate(q.graph, {node}, {}, kBits);
  if (!value || !is_bounded((*value)[0].enclosure()))
    throw Rejection(what + " has no certain value");
  return (*value)[0];
}

/// The doubles certainly between two values.
std::optional<Interval> between(const Ball& lo, const Ball& hi) {
  const Interval inner{lo.enclosure().hi, hi.enclosure().lo};
  if (!(inner.lo <= inner.hi)) return std::nullopt;
  return inner;
}

/// The middle of a ball is a double nearby at most: by that much more its points are away from it.
double reach_ru(const Question& q, const BallOfVariables& ball, const Box& outer) {
  double sum = mag(constant(q, ball.radius, "the radius of a ball").enclosure());
  for (std::size_t i = 0; i < ball.members.size(); ++i) {
    const Interval middle = constant(q, ball.middles[i], "the middle of a ball").enclosure();
    sum = up(sum + mag(middle - point(mid(outer[ball.members[i]]))));
  }
  return sum;
}

}  // namespace

Variety enclose_variety(const Question& q) {
  Variety variety;
  for (const Variable& v : q.variables) {
    const Ball lo = constant(q, v.lo, "the lower end of " + v.name);
    const Ball hi = constant(q, v.hi, "the upper end of " + v.name);
    if (arb_lt(hi.get(), lo.get())) throw Rejection("the range of " + v.name + " is empty");
    variety.outer.push_back(hull(lo.enclosure(), hi.enclosure()));
    variety.inner.push_back(between(lo, hi));
  }
  for (const BallOfVariables& ball : q.balls)
    variety.reach.push_back(reach_ru(q, ball, variety.outer));
  const Ball alpha = constant(q, q.alpha, "alpha");
  if (arb_is_negative(alpha.get())) throw Rejection("alpha is negative");
  variety.alpha = alpha.enclosure();
  return variety;
}

bool certain_inside(const Question& q, const Variety& variety, const Box& point) {
  for (std::size_t k = 0; k < point.size(); ++k) {
    const auto& inner = variety.inner[k];
    const Interval x = point[k], outer = variety.outer[k];
    // The one value of such a range is somewhere in `outer`, which x must then hold.
    if (inner ? !(inner->lo <= x.lo && x.hi <= inner->hi) : !(x.lo <= outer.lo && outer.hi <= x.hi))
      return false;
  }
  for (const BallOfVariables& ball : q.balls) {
    Ball sum, difference;
    for (std::size_t i = 0; i < ball.members.size(); ++i) {
      const Ball middle = constant(q, ball.middles[i], "the middle of a ball");
      arb_sub(difference.get(), Ball(point[ball.members[i]], kBits).get(), middle.get(), kBits);
      arb_addmul(sum.get(), difference.get(), difference.get(), kBits);
    }
    const Ball radius = constant(q, ball.radius, "a radius");
    arb_mul(difference.get(), radius.get(), radius.get(), kBits);
    if (!arb_le(sum.get(), difference.get())) return false;
  }
  return true;
}

}  // namespace regulus::verifier
