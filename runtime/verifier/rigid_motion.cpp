// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

bool GraphAlgebra::is_number(NodeId node, long value) const {
  const Node& known = graph_.nodes()[std::size_t(node)];
  return known.op == Op::kConstant && graph_.rational(known.a) == Rational(value);
}

NodeId GraphAlgebra::sum(NodeId a, NodeId b) {
  if (is_number(a, 0)) return b;
  return is_number(b, 0) ? a : graph_.add(Op::kAdd, a, b);
}

NodeId GraphAlgebra::difference(NodeId a, NodeId b) {
  if (is_number(b, 0)) return a;
  return is_number(a, 0) ? negative(b) : graph_.add(Op::kSubtract, a, b);
}

NodeId GraphAlgebra::product(NodeId a, NodeId b) {
  if (is_number(a, 0) || is_number(b, 1)) return a;
  if (is_number(b, 0) || is_number(a, 1)) return b;
  return graph_.add(Op::kMultiply, a, b);
}

NodeId GraphAlgebra::quotient(NodeId a, NodeId b) {
  return is_number(b, 1) ? a : graph_.add(Op::kDivide, a, b);
}

NodeId GraphAlgebra::negative(NodeId a) { return is_number(a, 0) ? a : graph_.add(Op::kNegate, a); }

NodeId GraphAlgebra::root(NodeId a) {
  return is_number(a, 0) || is_number(a, 1) ? a : graph_.add(Op::kSqrt, a);
}

NodeId GraphAlgebra::sine(NodeId angle) {
  return is_number(angle, 0) ? angle : graph_.add(Op::kSin, angle);
}

NodeId GraphAlgebra::cosine(NodeId angle) {
  return is_number(angle, 0) ? number(1) : graph_.add(Op::kCos, angle);
}

NodeId GraphAlgebra::degrees(NodeId count) {
  return product(count, graph_.add(Op::kDivide, graph_.add(Op::kPi), number(180)));
}

VectorNodes GraphAlgebra::zero() {
  const NodeId none = number(0);
  return {none, none, none};
}

VectorNodes GraphAlgebra::sum(const VectorNodes& u, const VectorNodes& v) {
  return {sum(u[0], v[0]), sum(u[1], v[1]), sum(u[2], v[2])};
}

VectorNodes GraphAlgebra::difference(const VectorNodes& u, const VectorNodes& v) {
  return {difference(u[0], v[0]), difference(u[1], v[1]), difference(u[2], v[2])};
}

VectorNodes GraphAlgebra::scaled(NodeId factor, const VectorNodes& v) {
  return {product(factor, v[0]), product(factor, v[1]), product(factor, v[2])};
}

NodeId GraphAlgebra::dot(const VectorNodes& u, const VectorNodes& v) {
  return sum(sum(product(u[0], v[0]), product(u[1], v[1])), product(u[2], v[2]));
}

VectorNodes GraphAlgebra::cross(const VectorNodes& u, const VectorNodes& v) {
  return {difference(product(u[1], v[2]), product(u[2], v[1])),
          difference(product(u[2], v[0]), product(u[0], v[2])),
          difference(product(u[0], v[1]), product(u[1], v[0]))};
}

VectorNodes GraphAlgebra::unit(const VectorNodes& v) {
  const NodeId length = root(dot(v, v));
  VectorNodes result = v;
  for (NodeId& component : result)
    if (!is_number(component, 0)) component = quotient(component, length);
  return result;
}

MatrixNodes GraphAlgebra::identity() {
  const NodeId one = number(1), none = number(0);
  return {{{one, none, none}, {none, one, none}, {none, none, one}}};
}

MatrixNodes GraphAlgebra::transposed(const MatrixNodes& A) {
  MatrixNodes result = A;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = A[j][i];
  return result;
}

MatrixNodes GraphAlgebra::product(const MatrixNodes& A, const MatrixNodes& B) {
  const MatrixNodes columns = transposed(B);
  MatrixNodes result = A;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = dot(A[i], columns[j]);
  return result;
}

VectorNodes GraphAlgebra::product(const MatrixNodes& A, const VectorNodes& v) {
  return {dot(A[0], v), dot(A[1], v), dot(A[2], v)};
}

MatrixNodes GraphAlgebra::turn(std::size_t axis, NodeId angle) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  MatrixNodes result = identity();
  result[next][next] = result[last][last] = cosine(angle);
  result[last][next] = sine(angle);
  result[next][last] = negative(result[last][next]);
  return result;
}

/// By Rodrigues: cos·I + (1 − cos)·a·aᵀ + sin·[a ×].
MatrixNodes GraphAlgebra::turn(const VectorNodes& a, NodeId angle) {
  const NodeId c = cosine(angle), s = sine(angle), rest = difference(number(1), c);
  const NodeId none = number(0);
  const MatrixNodes across = {{{none, negative(a[2]), a[1]},  //
                               {a[2], none, negative(a[0])},
                               {negative(a[1]), a[0], none}}};
  MatrixNodes result = identity();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result[i][j] = sum(sum(product(c, result[i][j]), product(rest, product(a[i], a[j]))),
                         product(s, across[i][j]));
  return result;
}

/// |q|²·(q·x·q⁻¹), column by column: w²x + 2w(v × x) + 2v(v·x) − (v·v)x.
MatrixNodes GraphAlgebra::scaled_turn(const std::array<NodeId, 4>& q) {
  const NodeId w = q[0], two = number(2);
  const VectorNodes v = {q[1], q[2], q[3]};
  const NodeId along = difference(square(w), dot(v, v));
  MatrixNodes columns = identity();
  for (std::size_t j = 0; j < 3; ++j) {
    const VectorNodes x = identity()[j];
    const VectorNodes turned = sum(scaled(along, x), scaled(product(two, w), cross(v, x)));
    columns[j] = sum(turned, scaled(product(two, v[j]), v));
  }
  return transposed(columns);
}

NodeId GraphAlgebra::squared_norm(const std::array<NodeId, 4>& q) {
  const VectorNodes v = {q[1], q[2], q[3]};
  return sum(square(q[0]), dot(v, v));
}

MatrixNodes GraphAlgebra::turn_of_quaternion(const std::array<NodeId, 4>& q) {
  const NodeId norm = squared_norm(q);
  MatrixNodes result = scaled_turn(q);
  for (VectorNodes& row : result)
    for (NodeId& entry : row) entry = quotient(entry, norm);
  return result;
}

MatrixNodes GraphAlgebra::turn_of_roll_pitch_yaw(const VectorNodes& rpy) {
  return product(turn(2, rpy[2]), product(turn(1, rpy[1]), turn(0, rpy[0])));
}

PlacementNodes GraphAlgebra::at_rest() { return {identity(), zero()}; }

PlacementNodes GraphAlgebra::product(const PlacementNodes& first, const PlacementNodes& second) {
  return {product(first.R, second.R), sum(product(first.R, second.p), first.p)};
}

PlacementNodes GraphAlgebra::inverse(const PlacementNodes& T) {
  const MatrixNodes back = transposed(T.R);
  return {back, difference(zero(), product(back, T.p))};
}

}  // namespace regulus::verifier
