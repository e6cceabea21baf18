// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of an interval program. They do not use CLN: any thread may read them.
#pragma once

#include <cstdint>

namespace regulus::detail {

enum class Op : std::uint8_t {
  kConstant,  // an exact rational
  kNumberPi,
  kInput,  // variable number `index`, an interval
  kPoint,  // entry number `index` of K, an exact double
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,  // undefined where b = 0
  kPower,   // a^index, index ≥ 2; negative powers are 1/a^n; a·a is a^2
  kSqrt,    // undefined where a < 0
  kSin,
  kCos,
  kTan,   // undefined where cos a = 0
  kAsin,  // undefined where |a| > 1
  kAcos,
  kAtan,
  kAtan2,  // atan2(a, b), a = ordinate; undefined where a = 0 and b ≤ 0
  kExp,
  kLog,  // undefined where a ≤ 0
  kAbs,
};

using NodeId = std::uint32_t;

/// Returns how many of Node::a and Node::b the operation reads.
[[nodiscard]] int operand_count(Op op) noexcept;

/// Returns the operation's name in texts: "constant", "add", "sqrt", "atan2" …
[[nodiscard]] const char* op_name(Op op) noexcept;

struct Node {
  Op op;
  NodeId a = 0;
  NodeId b = 0;
  std::uint32_t index = 0;  ///< of the constant, input or point; the exponent of kPower
};

}  // namespace regulus::detail
