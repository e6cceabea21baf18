// SPDX-License-Identifier: GPL-3.0-or-later
// The interval program: straight-line code over exact constants, in canonical order. What the
// emitter prints and the interpreter runs.
#pragma once

#include <cln/rational.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace regulus::codegen {

enum class Op : std::uint8_t {
  kConstant,  // an exact rational
  kPi,
  kInput,     // variable number `index`, an interval
  kPoint,     // entry number `index` of K, an exact double
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,    // undefined where b = 0
  kPower,     // a^index, index ≥ 2; negative powers are 1/a^n
  kSqrt,      // undefined where a < 0
  kSin,
  kCos,
  kTan,       // undefined where cos a = 0
  kAsin,      // undefined where |a| > 1
  kAcos,
  kAtan,
  kAtan2,     // atan2(a, b), a = ordinate; undefined where a = 0 and b ≤ 0
  kExp,
  kLog,       // undefined where a ≤ 0
  kAbs,
};

using NodeId = std::uint32_t;

struct Node {
  Op op;
  NodeId a = 0;
  NodeId b = 0;
  std::uint32_t index = 0;  ///< of the constant, input or point; the exponent of kPower
};

/// Straight-line code. Operands come before their use; no two nodes are equal; every node is used.
struct Program {
  std::vector<Node> nodes;
  std::vector<cln::cl_RA> constants;
  std::vector<std::string> inputs;  ///< names of the variables, by index
  std::vector<std::string> points;  ///< names of the entries of K, by index
  std::vector<NodeId> outputs;
};

/// Builds a Program with common sub-expressions shared. Sums and products of two operands are
/// stored in the order they are given: the caller decides on a canonical order. Trivial identities
/// (x + 0, 1·x, 0·x, −(−x), operations on two rational constants) are folded exactly; 0·x keeps x
/// when x can be undefined.
class ProgramBuilder {
 public:
  ProgramBuilder(std::vector<std::string> inputs, std::vector<std::string> points);

  NodeId constant(const cln::cl_RA& value);
  NodeId pi();
  NodeId input(std::uint32_t index);
  NodeId point(std::uint32_t index);
  NodeId negate(NodeId a);
  NodeId add(NodeId a, NodeId b);
  NodeId subtract(NodeId a, NodeId b);
  NodeId multiply(NodeId a, NodeId b);
  NodeId divide(NodeId a, NodeId b);
  NodeId power(NodeId a, int exponent);  ///< any integer; negative becomes a division
  NodeId call(Op function, NodeId a);    ///< kSqrt … kAbs except kAtan2
  NodeId atan2(NodeId a, NodeId b);

  void output(NodeId node);

  /// The program of the nodes that the outputs use, in canonical order. The builder is spent.
  [[nodiscard]] Program finish() &&;

 private:
  NodeId intern(Node node);

  Program program_;
  std::map<std::tuple<Op, NodeId, NodeId, std::uint32_t>, NodeId> known_;
  std::map<std::string, std::uint32_t> constant_index_;
};

}  // namespace regulus::codegen
