// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/exact_range.hpp"

#include <algorithm>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/elementary.hpp"

namespace regulus::verifier {
namespace {

// Beyond these bounds, the enclosure in doubles is used.
constexpr std::size_t kMostNodesOfRange = 1 << 10;
constexpr std::size_t kMostBitsOfEnd = 1 << 12;
constexpr int kMostPowerOfRange = 64;

bool is_less(const Rational& x, const Rational& y) { return (x - y).sign() < 0; }
const Rational& least(const Rational& x, const Rational& y) { return is_less(y, x) ? y : x; }
const Rational& greatest(const Rational& x, const Rational& y) { return is_less(x, y) ? y : x; }

RationalRange negative(const RationalRange& x) {
  const Rational minus(-1);
  return {x.hi * minus, x.lo * minus};
}

RationalRange sum(const RationalRange& x, const RationalRange& y) {
  return {x.lo + y.lo, x.hi + y.hi};
}

RationalRange product(const RationalRange& x, const RationalRange& y) {
  const Rational a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
  return {least(least(a, b), least(c, d)), greatest(greatest(a, b), greatest(c, d))};
}

RationalRange magnitude(const RationalRange& x) {
  if (x.lo.sign() >= 0) return x;
  const RationalRange turned = negative(x);
  if (x.hi.sign() <= 0) return turned;
  return {Rational(), greatest(x.hi, turned.hi)};
}

/// Returns nullopt if y may be 0.
std::optional<RationalRange> quotient(const RationalRange& x, const RationalRange& y) {
  if (y.lo.sign() <= 0 && y.hi.sign() >= 0) return std::nullopt;
  const Rational one(1);
  return product(x, {one / y.hi, one / y.lo});
}

/// Takes even powers of magnitudes; odd powers are monotone.
std::optional<RationalRange> power(const RationalRange& x, int exponent) {
  if (exponent > kMostPowerOfRange) return std::nullopt;
  const RationalRange base = exponent % 2 == 0 ? magnitude(x) : x;
  RationalRange result = base;
  for (int i = 1; i < exponent; ++i) {
    if (std::max(result.lo.bits(), result.hi.bits()) > kMostBitsOfEnd) return std::nullopt;
    result = {result.lo * base.lo, result.hi * base.hi};
  }
  return result;
}

Interval outward(const RationalRange& x) { return {enclose(x.lo).lo, enclose(x.hi).hi}; }

/// Uses Arb, whose value is exact if the root is a double. The root of intervals is not exact.
Interval root(Interval x) {
  constexpr long kBitsOfRange = 64;
  if (!(x.lo >= 0.0)) return everything();
  Ball lo(point(x.lo), kBitsOfRange), hi(point(x.hi), kBitsOfRange);
  arb_sqrt(lo.get(), lo.get(), kBitsOfRange);
  arb_sqrt(hi.get(), hi.get(), kBitsOfRange);
  return hull(lo.enclosure(), hi.enclosure());
}

}  // namespace

Interval ExactRanges::of(NodeId node) {
  const RationalRange x = range(node);
  return is_empty_ ? everything() : outward(x);
}

/// The recursion is as deep as the graph, at most format::kDeepestNode.
RationalRange ExactRanges::range(NodeId id) {
  if (const auto known = known_.find(id); known != known_.end()) return known->second;
  std::optional<RationalRange> result;
  if (known_.size() < kMostNodesOfRange) result = exact(graph_.nodes()[std::size_t(id)]);
  if (!result || result->lo.bits() > kMostBitsOfEnd || result->hi.bits() > kMostBitsOfEnd) {
    const Interval value = values_[std::size_t(id)];
    result = RationalRange{rational_of(value.lo), rational_of(value.hi)};
  }
  known_.emplace(id, *result);
  return *result;
}

std::optional<RationalRange> ExactRanges::exact(const Node& node) {
  switch (node.op) {
    case Op::kConstant:
      return RationalRange{graph_.rational(node.a), graph_.rational(node.a)};
    case Op::kVariable:
      return variable(std::size_t(node.a));
    case Op::kNegate:
      return negative(range(node.a));
    case Op::kAdd:
      return sum(range(node.a), range(node.b));
    case Op::kSubtract:
      return sum(range(node.a), negative(range(node.b)));
    case Op::kMultiply:
      return node.a == node.b ? power(range(node.a), 2) : product(range(node.a), range(node.b));
    case Op::kDivide:
      return quotient(range(node.a), range(node.b));
    case Op::kPower:
      return power(range(node.a), node.b);
    case Op::kAbs:
      return magnitude(range(node.a));
    case Op::kSign:
    case Op::kPi:
    case Op::kAtan2:
      return std::nullopt;
    default:
      return function(node);
  }
}

/// log of exactly [1, 2] is at least 0, but log of [1 − 2⁻⁵³, 2] may be below 0.
std::optional<RationalRange> ExactRanges::function(const Node& node) {
  const Interval argument = outward(range(node.a));
  if (!is_bounded(argument)) return std::nullopt;
  const Interval value = node.op == Op::kSqrt ? root(argument) : apply(node.op, argument);
  if (!is_bounded(value)) return std::nullopt;
  return RationalRange{rational_of(value.lo), rational_of(value.hi)};
}

/// Returns the part of the box that is within the range.
RationalRange ExactRanges::variable(std::size_t k) {
  RationalRange x{rational_of(box_[k].lo), rational_of(box_[k].hi)};
  if (k < ends_.size() && ends_[k].lo) x.lo = greatest(x.lo, *ends_[k].lo);
  if (k < ends_.size() && ends_[k].hi) x.hi = least(x.hi, *ends_[k].hi);
  is_empty_ = is_empty_ || is_less(x.hi, x.lo);
  return x;
}

}  // namespace regulus::verifier
