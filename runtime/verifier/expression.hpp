// SPDX-License-Identifier: Apache-2.0
// The expressions of a certificate as a graph in which equal sub-expressions are one node.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "runtime/verifier/rational.hpp"

namespace regulus::verifier {

/// The file is not a certificate, or proves nothing; the text says what is wrong.
class Rejection : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Neither a proof nor a refutation was found; the text gives the reason.
class Unfinished : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Op {
  kConstant,  ///< rationals()[a]
  kPi,
  kVariable,  ///< number a
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kPower,  ///< node a to the integer b ≥ 1
  kSqrt,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kExp,
  kLog,
  kAbs,
  kAtan2,
  kSign,  ///< in derivatives only: 1 for a > 0, −1 for a < 0, all of [−1, 1] for 0
};

/// Returns the number of operands of an operation: `a`, or `a` and `b`.
[[nodiscard]] constexpr int operands(Op op) noexcept {
  switch (op) {
    case Op::kConstant:
    case Op::kPi:
    case Op::kVariable:
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

using NodeId = int;
inline constexpr NodeId kNoNode = -1;

struct Node {
  Op op;
  NodeId a = 0, b = 0;
};

/// Operands come before the nodes that use them.
class Graph {
 public:
  /// Adds a node. An operation on rational constants alone is computed exactly.
  [[nodiscard]] NodeId add(Op op, int a = 0, int b = 0);
  /// Adds a decimal such as 12, 0.5 or 1e-3, exactly.
  [[nodiscard]] NodeId number(std::string_view digits);
  [[nodiscard]] NodeId number(const Rational& value);
  /// Gives variable k the number numbers[k]; all differ.
  void renumber_variables(const std::vector<int>& numbers);
  /// Call it after reading the file: from now on too many operations throw Unfinished.
  void end_of_file() noexcept { is_read_ = true; }

  [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const Rational& rational(int index) const { return rationals_[std::size_t(index)]; }

 private:
  /// Returns the value of an operation on rational constants; nullopt for all others, and for x/0.
  [[nodiscard]] std::optional<Rational> folded(Op op, int a, int b) const;

  std::vector<Node> nodes_;
  std::vector<int> depth_;  ///< bounded, so the depth of recursion is bounded
  std::map<std::tuple<Op, int, int>, NodeId> known_;
  std::map<std::string, NodeId, std::less<>> numbers_;
  std::deque<Rational> rationals_;
  std::size_t folded_bits_ = 0;
  bool is_read_ = false;
};

using Scope = std::map<std::string, NodeId, std::less<>>;

/// Returns the node of an expression of FORMAT.md with the names of `scope`. Throws Rejection.
[[nodiscard]] NodeId parse(std::string_view text, const Scope& scope, Graph& graph);

/// Returns true if the text can be a name.
[[nodiscard]] bool is_name(std::string_view text) noexcept;

/// Returns true if the text is a name that expressions use themselves: pi and the functions.
[[nodiscard]] bool is_reserved(std::string_view text) noexcept;
/// Returns the function of a name that is reserved and not pi.
[[nodiscard]] Op function_named(std::string_view text) noexcept;

}  // namespace regulus::verifier
