// SPDX-License-Identifier: Apache-2.0
// Quaternions and rigid motions. A motion p ↦ Rp + t is a pair (x : y) up to a factor: R is the
// rotation of x, x·x ≠ 0, and y = tx. Number: Complex, or Interval or Rectangle, which enclose.
#pragma once

#include <array>
#include <cstddef>

namespace regulus::detail {

template <class Number>
using Quaternion = std::array<Number, 4>;  ///< w x y z

template <class Number>
Number dot(const Quaternion<Number>& p, const Quaternion<Number>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

template <class Number>
Quaternion<Number> operator*(const Quaternion<Number>& p, const Quaternion<Number>& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
          p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
          p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

template <class Number>
Quaternion<Number> operator+(const Quaternion<Number>& p, const Quaternion<Number>& q) {
  return {p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]};
}

template <class Number>
Quaternion<Number> conj(const Quaternion<Number>& q) {
  const Number zero{};
  return {q[0], zero - q[1], zero - q[2], zero - q[3]};
}

template <class Number>
struct DualQuaternion {
  Quaternion<Number> x{}, y{};
};

/// First the right one, then the left one.
template <class Number>
DualQuaternion<Number> operator*(const DualQuaternion<Number>& p, const DualQuaternion<Number>& q) {
  return {p.x * q.x, p.x * q.y + p.y * q.x};
}

template <class Number>
DualQuaternion<Number> operator+(const DualQuaternion<Number>& p, const DualQuaternion<Number>& q) {
  return {p.x + q.x, p.y + q.y};
}

/// The motion back: it is this up to a factor, because x·y = 0.
template <class Number>
DualQuaternion<Number> conj(const DualQuaternion<Number>& q) {
  return {conj(q.x), conj(q.y)};
}

/// (v + uk)q: q, and then a turn about z by 2·arctan(u/v).
template <class Number>
Quaternion<Number> turned(const Number& u, const Number& v, const Quaternion<Number>& q) {
  return {v * q[0] - u * q[3], v * q[1] - u * q[2], v * q[2] + u * q[1], v * q[3] + u * q[0]};
}

template <class Number>
DualQuaternion<Number> turned(const Number& u, const Number& v, const DualQuaternion<Number>& q) {
  return {turned(u, v, q.x), turned(u, v, q.y)};
}

}  // namespace regulus::detail
