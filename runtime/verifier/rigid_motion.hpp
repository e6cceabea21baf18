// SPDX-License-Identifier: Apache-2.0
// Vectors, rotations and placements whose numbers are expressions of a graph.
#pragma once

#include <array>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

using VectorNodes = std::array<NodeId, 3>;
using MatrixNodes = std::array<VectorNodes, 3>;  ///< row by row

/// x ↦ R·x + p.
struct PlacementNodes {
  MatrixNodes R;
  VectorNodes p;
};

/// Adds operations to a graph, without terms that are the number 0 and factors that are 0 or 1.
class GraphAlgebra {
 public:
  explicit GraphAlgebra(Graph& graph) : graph_(graph) {}

  [[nodiscard]] Graph& graph() noexcept { return graph_; }
  [[nodiscard]] NodeId number(long value) { return graph_.number(Rational(value)); }
  [[nodiscard]] bool is_number(NodeId node, long value) const;

  [[nodiscard]] NodeId sum(NodeId a, NodeId b);
  [[nodiscard]] NodeId difference(NodeId a, NodeId b);
  [[nodiscard]] NodeId product(NodeId a, NodeId b);
  [[nodiscard]] NodeId quotient(NodeId a, NodeId b);
  [[nodiscard]] NodeId negative(NodeId a);
  [[nodiscard]] NodeId square(NodeId a) { return product(a, a); }
  [[nodiscard]] NodeId root(NodeId a);
  [[nodiscard]] NodeId sine(NodeId angle);
  [[nodiscard]] NodeId cosine(NodeId angle);
  /// Returns the angle of so many degrees.
  [[nodiscard]] NodeId degrees(NodeId number);

  [[nodiscard]] VectorNodes zero();
  [[nodiscard]] VectorNodes sum(const VectorNodes& u, const VectorNodes& v);
  [[nodiscard]] VectorNodes difference(const VectorNodes& u, const VectorNodes& v);
  [[nodiscard]] VectorNodes scaled(NodeId factor, const VectorNodes& v);
  [[nodiscard]] NodeId dot(const VectorNodes& u, const VectorNodes& v);
  [[nodiscard]] VectorNodes cross(const VectorNodes& u, const VectorNodes& v);
  /// Returns v/|v|.
  [[nodiscard]] VectorNodes unit(const VectorNodes& v);

  [[nodiscard]] MatrixNodes identity();
  [[nodiscard]] MatrixNodes transposed(const MatrixNodes& A);
  [[nodiscard]] MatrixNodes product(const MatrixNodes& A, const MatrixNodes& B);
  [[nodiscard]] VectorNodes product(const MatrixNodes& A, const VectorNodes& v);
  /// Returns the rotation by an angle about coordinate axis `axis`, 0 to 2.
  [[nodiscard]] MatrixNodes turn(std::size_t axis, NodeId angle);
  /// Returns the rotation by an angle about a unit vector.
  [[nodiscard]] MatrixNodes turn(const VectorNodes& axis, NodeId angle);
  /// Returns |q|² times the rotation of q/|q|, q = (w, x, y, z).
  [[nodiscard]] MatrixNodes scaled_turn(const std::array<NodeId, 4>& q);
  [[nodiscard]] NodeId squared_norm(const std::array<NodeId, 4>& q);
  /// Returns the rotation of q/|q|.
  [[nodiscard]] MatrixNodes turn_of_quaternion(const std::array<NodeId, 4>& q);
  /// Returns the rotation Rz(yaw)·Ry(pitch)·Rx(roll).
  [[nodiscard]] MatrixNodes turn_of_roll_pitch_yaw(const VectorNodes& rpy);

  [[nodiscard]] PlacementNodes at_rest();
  /// Returns x ↦ first(second(x)).
  [[nodiscard]] PlacementNodes product(const PlacementNodes& first, const PlacementNodes& second);
  [[nodiscard]] PlacementNodes inverse(const PlacementNodes& T);

 private:
  Graph& graph_;
};

}  // namespace regulus::verifier
