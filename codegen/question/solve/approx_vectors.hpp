// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors in doubles, for what is shown afterwards.
#pragma once

#include <cmath>
#include <utility>

#include "codegen/question/solve/arm_chain.hpp"

namespace regulus::detail {

using Point3 = std::array<double, 3>;

inline Point3 middle(const Vector3& v) { return {mid(v[0]), mid(v[1]), mid(v[2])}; }
inline double approx_dot(const Point3& u, const Point3& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline Point3 approx_cross(const Point3& u, const Point3& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The angle about `axis` from one vector to another, and how long their parts across it are.
inline std::pair<double, double> approx_angle(const Point3& axis, const Point3& from,
                                              const Point3& to) {
  const double along = approx_dot(axis, from) * approx_dot(axis, to);
  const double c = approx_dot(from, to) - along, s = approx_dot(axis, approx_cross(from, to));
  return {std::atan2(s, c), std::hypot(c, s)};
}

/// The unit vector of the frame that is farthest from the direction of v.
inline Vector3 farthest_unit(const Vector3& v) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (mag(v[i]) < mag(v[least])) least = i;
  Vector3 unit = {0.0, 0.0, 0.0};
  unit[least] = Interval(1.0);
  return unit;
}

}  // namespace regulus::detail
