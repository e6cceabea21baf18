// SPDX-License-Identifier: GPL-3.0-or-later
// The interval program: straight-line code over exact constants, in canonical order. The emitter
// prints it and the interpreter runs it.
#pragma once

#include <cln/rational.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/kernel/program/node.hpp"

namespace regulus::detail {

/// Straight-line code. Operands come before their use; no two nodes are equal; every node is used.
struct Program {
  std::vector<Node> nodes;
  std::vector<cln::cl_RA> constants;
  std::vector<std::string> inputs;  ///< names of the variables, by index
  std::vector<std::string> points;  ///< names of the entries of K, by index
  std::vector<NodeId> outputs;
};

/// Builds a Program with common sub-expressions shared. Sums and products of two operands are
/// stored in the given order: the caller chooses a canonical order (a·b after b·a is b·a again).
/// Trivial identities (x + 0, 1·x, 0·x, −(−x), x·x = x², operations on rational constants) are
/// folded exactly and never lose a condition of definedness: 0·x keeps x when x can be undefined,
/// and x/x stays. Signs move outwards, so that expressions that differ only in sign are shared,
/// too: −7·x is −(7·x), and b − a after a − b is −(a − b).
///
/// Requires  every NodeId comes from this builder; indices name a declared input or point.
///           std::out_of_range otherwise.
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

  /// Returns the node that has the point `further` places further on for each point of `node`.
  NodeId moved(NodeId node, std::uint32_t further);

  void output(NodeId node);

  /// Returns the number of nodes.
  [[nodiscard]] std::size_t size() const noexcept { return program_.nodes.size(); }

  /// Returns the program of the nodes that the outputs use, in canonical order. The builder cannot
  /// be used again.
  [[nodiscard]] Program finish() &&;

 private:
  struct ValueOrder {
    bool operator()(const cln::cl_RA& x, const cln::cl_RA& y) const {
      return cln::compare(x, y) < 0;
    }
  };

  /// Operation, operands, and index.
  using Key = std::array<std::uint32_t, 4>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  static Key key_of(const Node& node) noexcept;

  NodeId intern(Node node);
  void require(NodeId id) const;
  [[nodiscard]] const Node& at(NodeId id) const { return program_.nodes.at(id); }
  [[nodiscard]] bool is_constant(NodeId id) const { return at(id).op == Op::kConstant; }
  [[nodiscard]] bool is_negation(NodeId id) const { return at(id).op == Op::kNegate; }
  [[nodiscard]] const cln::cl_RA& value(NodeId id) const {
    return program_.constants[at(id).index];
  }
  [[nodiscard]] bool is_zero(NodeId id) const;
  [[nodiscard]] bool is_total(const Node& node) const;
  NodeId scale(const cln::cl_RA& factor, NodeId a);
  NodeId zero_where_defined(NodeId a);

  Program program_;
  std::vector<bool> total_;  ///< per node: certainly defined for every value of inputs and points
  std::unordered_map<Key, NodeId, KeyHash> known_;
  std::map<std::uint32_t, std::vector<NodeId>> moved_;  // by `further`, then by node; or kUnknown
  std::map<cln::cl_RA, std::uint32_t, ValueOrder> constant_index_;
};

}  // namespace regulus::detail
