// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/node.hpp"

#include <cstddef>

namespace regulus::detail {

int operand_count(Op op) noexcept {
  switch (op) {
    case Op::kConstant:
    case Op::kNumberPi:
    case Op::kInput:
    case Op::kPoint:
      return 0;
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
    case Op::kAtan2:
      return 2;
    default:
      return 1;
  }
}

const char* op_name(Op op) noexcept {
  static constexpr const char* kNames[] = {
      "constant", "pi",     "input", "point", "negate", "add", "subtract",
      "multiply", "divide", "power", "sqrt",  "sin",    "cos", "tan",
      "asin",     "acos",   "atan",  "atan2", "exp",    "log", "abs"};
  return kNames[static_cast<std::size_t>(op)];
}

}  // namespace regulus::detail
