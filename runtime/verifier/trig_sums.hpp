// SPDX-License-Identifier: Apache-2.0
// Sums of products of powers, cosines and sines of some unknowns, with expressions of a graph as coefficients.
#pragma once

#include <compare>
#include <map>
#include <vector>

#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

/// x^power·cos(frequency·x), or sin; without a frequency x^power alone.
struct TrigFunction {
  int power = 0;
  NodeId frequency = kNoNode;  ///< no negative number
  bool is_sine = false;
  friend auto operator<=>(const TrigFunction&, const TrigFunction&) = default;
};

/// A coefficient for each product of functions, one of each unknown.
using TrigSum = std::map<std::vector<TrigFunction>, NodeId>;
using TrigVector = std::array<TrigSum, 3>;

class TrigSums {
 public:
  /// The graph must outlive this object.
  TrigSums(Graph& graph, std::size_t unknowns) : a_(graph), none_(unknowns) {}

  [[nodiscard]] TrigSum constant(NodeId coefficient) const;
  [[nodiscard]] TrigSum sum(TrigSum x, const TrigSum& y, long factor = 1);
  [[nodiscard]] TrigSum scaled(NodeId factor, const TrigSum& x);
  [[nodiscard]] TrigSum times_unknown(const TrigSum& x, std::size_t unknown) const;

  [[nodiscard]] TrigVector constant(const VectorNodes& v) const;
  [[nodiscard]] TrigVector sum(TrigVector x, const TrigVector& y, long factor = 1);
  [[nodiscard]] TrigVector scaled(NodeId factor, const TrigVector& x);
  [[nodiscard]] TrigVector times_unknown(const TrigVector& x, std::size_t unknown) const;
  [[nodiscard]] TrigVector product(const MatrixNodes& R, const TrigVector& x);
  [[nodiscard]] TrigSum dot(const VectorNodes& u, const TrigVector& x);
  [[nodiscard]] TrigVector cross(const VectorNodes& u, const TrigVector& x);
  /// Turns it about a unit vector by `frequency` times an unknown, or back if `sign` is −1.
  [[nodiscard]] TrigVector turned(const TrigVector& x, const VectorNodes& axis, std::size_t unknown,
                                  NodeId frequency, long sign);

  /// Returns the expression by the unknowns. What several products have in common is taken out of them, that of the
  /// first unknown first.
  [[nodiscard]] NodeId expression(const TrigSum& x, const std::vector<NodeId>& unknowns);

 private:
  using Term = std::pair<std::vector<TrigFunction>, NodeId>;

  void add(TrigSum& to, const std::vector<TrigFunction>& functions, NodeId coefficient);
  void add_wave(TrigSum& to, Term term, std::size_t unknown, bool is_sine, NodeId frequency);
  [[nodiscard]] TrigSum times(const TrigSum& x, std::size_t unknown, bool by_sine,
                              NodeId frequency);
  [[nodiscard]] TrigVector times(const TrigVector& x, std::size_t unknown, bool by_sine,
                                 NodeId frequency);
  [[nodiscard]] NodeId function(const TrigFunction& f, NodeId unknown);
  [[nodiscard]] NodeId expression(std::vector<Term> terms, std::size_t from,
                                  const std::vector<NodeId>& unknowns);

  GraphAlgebra a_;
  const std::vector<TrigFunction> none_;
};

}  // namespace regulus::verifier
