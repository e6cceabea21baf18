// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/magnitude.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

constexpr long kInputExponent = 64;
constexpr long kPointExponent = 128;
constexpr long kGuardedExponent = 128;
constexpr long kFiniteExponent = 1024;
// sin and cos are ≤ 1, arcs ≤ π; the packs may exceed this in the last place.
constexpr long kSineExponent = 1;
constexpr long kArcExponent = 2;

long exponent_of(double bound) {
  if (!std::isfinite(bound)) return kFiniteExponent + 1;
  int exponent = 0;
  std::frexp(bound, &exponent);
  return std::max(exponent, 0);
}

/// Returns the exponent before a check, from the exponents of the operands.
long exponent(const Node& node, const std::vector<long>& known) {
  switch (node.op) {
    case Op::kInput:
      return kInputExponent;
    case Op::kPoint:
      return kPointExponent;
    case Op::kNegate:
    case Op::kAbs:
      return known[node.a];
    case Op::kAdd:
    case Op::kSubtract:
      return std::max(known[node.a], known[node.b]) + 1;
    case Op::kMultiply:
      return known[node.a] + known[node.b];
    case Op::kPower:
      return known[node.a] * static_cast<long>(node.index);
    case Op::kSin:
    case Op::kCos:
      return kSineExponent;
    case Op::kAtan:
      return kArcExponent;
    default:
      return kGuardedExponent;
  }
}

}  // namespace

Magnitudes bound_magnitudes(const Program& program, const KnownValues<Interval>& known) {
  const std::size_t count = program.nodes.size();
  Magnitudes result{std::vector<long>(count), std::vector<bool>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    const long bound = known[i] ? std::max(exponent_of(known[i]->lo), exponent_of(known[i]->hi))
                                : exponent(program.nodes[i], result.exponents);
    result.needs_check[i] = bound > kLargestSafeExponent;
    result.exponents[i] = result.needs_check[i] ? kFiniteExponent : bound;
  }
  return result;
}

}  // namespace regulus::detail
