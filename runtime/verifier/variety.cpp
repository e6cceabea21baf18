// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/variety.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/elementary.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfVariety = 128;
constexpr long kMostBitsOfVariety = 4096;

Ball constant(const Question& q, NodeId node, const std::string& what) {
  for (long bits = kBitsOfVariety; bits <= kMostBitsOfVariety; bits *= 4) {
    const auto value = evaluate(q.graph, {node}, {}, bits);
    if (value && is_bounded((*value)[0].enclosure())) return (*value)[0];
  }
  throw Unfinished(what + " has no certain value");
}

bool is_at_most(double x, const Rational& y) { return (rational_of(x) - y).sign() <= 0; }

/// Returns the doubles of a range with rational ends.
std::optional<Interval> exactly_between(const Rational& lo, const Rational& hi) {
  const Rational minus(-1);
  Interval inner{enclose(lo).lo, enclose(hi).hi};
  while (inner.lo < inner.hi && !is_at_most(-inner.lo, lo * minus))
    inner.lo = std::nextafter(inner.lo, kInfinity);
  while (inner.hi > inner.lo && !is_at_most(inner.hi, hi))
    inner.hi = std::nextafter(inner.hi, -kInfinity);
  if (!is_at_most(-inner.lo, lo * minus) || !is_at_most(inner.hi, hi)) return std::nullopt;
  if (!(inner.lo <= inner.hi)) return std::nullopt;
  return inner;
}

/// Returns the doubles that are certainly between two values.
std::optional<Interval> between(const Ball& lo, const Ball& hi) {
  const Interval inner{lo.enclosure().hi, hi.enclosure().lo};
  if (!(inner.lo <= inner.hi)) return std::nullopt;
  return inner;
}

/// Returns the radius of a ball plus the distance of its middle from the doubles used for it.
double reach_ru(const Question& q, const BallOfVariables& ball, const Box& outer) {
  double sum = mag(constant(q, ball.radius, "the radius of a ball").enclosure());
  for (std::size_t i = 0; i < ball.members.size(); ++i) {
    const Interval middle = constant(q, ball.middles[i], "the middle of a ball").enclosure();
    sum = up(sum + mag(middle - point(mid(outer[ball.members[i]]))));
  }
  return sum;
}

/// The squares of the distance of a point from the middle of a ball, and of the ball's radius.
struct Distances {
  Ball of_point, most;
};

Distances distances(const Question& q, const BallOfVariables& ball, const Box& point) {
  Distances result;
  Ball difference;
  for (std::size_t i = 0; i < ball.members.size(); ++i) {
    const Ball middle = constant(q, ball.middles[i], "the middle of a ball");
    arb_sub(difference.get(), Ball(point[ball.members[i]], kBitsOfVariety).get(), middle.get(),
            kBitsOfVariety);
    arb_addmul(result.of_point.get(), difference.get(), difference.get(), kBitsOfVariety);
  }
  const Ball radius = constant(q, ball.radius, "a radius");
  arb_mul(result.most.get(), radius.get(), radius.get(), kBitsOfVariety);
  return result;
}

}  // namespace

Variety enclose_variety(Question& q) {
  Variety variety;
  for (const Variable& v : q.variables) {
    const Ball lo = constant(q, v.lo, "the lower end of " + v.name);
    const Ball hi = constant(q, v.hi, "the upper end of " + v.name);
    const RationalEnds ends{exact_value(q.graph, v.lo), exact_value(q.graph, v.hi)};
    const bool is_exact = ends.lo && ends.hi;
    if (arb_lt(hi.get(), lo.get()) || (is_exact && (*ends.hi - *ends.lo).sign() < 0))
      throw Rejection("the range of " + v.name + " is empty");
    const Interval outer = hull(lo.enclosure(), hi.enclosure());
    variety.outer.push_back(outer);
    variety.inner.push_back(is_exact ? exactly_between(*ends.lo, *ends.hi) : between(lo, hi));
    variety.exact.push_back(is_exact);
    // A tube leads to points beyond the ranges: nothing about it may use their exact ends.
    q.ends.push_back(q.closure || q.solutions ? RationalEnds() : ends);
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
    // The one value of such a range is somewhere in `outer`, so x must contain `outer`.
    if (inner ? !(inner->lo <= x.lo && x.hi <= inner->hi) : !(x.lo <= outer.lo && outer.hi <= x.hi))
      return false;
  }
  for (const BallOfVariables& ball : q.balls) {
    const Distances d = distances(q, ball, point);
    if (arb_le(d.of_point.get(), d.most.get()) == 0) return false;
  }
  return true;
}

bool certain_outside(const Question& q, const Variety& variety, const Box& point) {
  for (std::size_t k = 0; k < point.size(); ++k) {
    const Interval x = point[k], outer = variety.outer[k];
    const auto& inner = variety.inner[k];
    if (x.hi < outer.lo || x.lo > outer.hi) return true;
    if (variety.exact[k] && inner && (x.hi < inner->lo || x.lo > inner->hi)) return true;
  }
  for (const BallOfVariables& ball : q.balls) {
    const Distances d = distances(q, ball, point);
    if (arb_gt(d.of_point.get(), d.most.get()) != 0) return true;
  }
  return false;
}

}  // namespace regulus::verifier
