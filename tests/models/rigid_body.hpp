// SPDX-License-Identifier: GPL-3.0-or-later
// Points and directions of a moving body: its pose now, and the change of these with a twist.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tests/models/dual.hpp"

namespace regulus::detail::test {

constexpr double kDegree = std::numbers::pi / 180;

template <typename Number>
using Vector = std::array<Number, 3>;

template <typename A, typename B>
auto operator+(const Vector<A>& a, const Vector<B>& b) {
  return Vector<decltype(a[0] + b[0])>{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <typename A, typename B>
auto operator-(const Vector<A>& a, const Vector<B>& b) {
  return Vector<decltype(a[0] - b[0])>{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename Number>
Vector<Number> operator*(Number factor, const Vector<Number>& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}
template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename Number>
Number norm(const Vector<Number>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
inline Vector<Dual> constant(const Vector<double>& v) {
  return {Dual{v[0]}, Dual{v[1]}, Dual{v[2]}};
}
inline Vector<double> values(const Vector<Dual>& v) { return {v[0].value, v[1].value, v[2].value}; }

/// Returns the direction at an angle in the plane z = 0.
inline Vector<double> direction(double degrees) {
  return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0};
}

using Rotation = std::array<Vector<double>, 3>;  ///< by rows

inline Vector<double> operator*(const Rotation& R, const Vector<double>& v) {
  return {dot(R[0], v), dot(R[1], v), dot(R[2], v)};
}

/// Turns v about axis 0, 1 or 2, by an angle in rad.
inline Vector<double> turned(int axis, double angle, const Vector<double>& v) {
  const auto j = std::size_t(axis + 1) % 3, k = std::size_t(axis + 2) % 3;
  Vector<double> result = v;
  result[j] = std::cos(angle) * v[j] - std::sin(angle) * v[k];
  result[k] = std::sin(angle) * v[j] + std::cos(angle) * v[k];
  return result;
}

/// A body at a pose that moves with one of the six unit twists: along x y z, about x y z.
class MovingBody {
 public:
  MovingBody(Vector<double> position, double roll, double pitch, double yaw, std::size_t twist)
      : position_(position), angles_{roll, pitch, yaw} {
    (twist < 3 ? velocity_ : spin_)[twist % 3] = 1;
  }

  /// Returns a direction of the body, in the frame of the base.
  [[nodiscard]] Vector<Dual> along(const Vector<double>& v) const {
    const Vector<double> here =
        turned(2, angles_[2], turned(1, angles_[1], turned(0, angles_[0], v)));
    return with_slope(here, cross(spin_, here));
  }

  /// Returns a point of the body, in the frame of the base.
  [[nodiscard]] Vector<Dual> at(const Vector<double>& point) const {
    return with_slope(position_, velocity_) + along(point);
  }

 private:
  static Vector<Dual> with_slope(const Vector<double>& v, const Vector<double>& slope) {
    return {Dual{v[0], slope[0]}, Dual{v[1], slope[1]}, Dual{v[2], slope[2]}};
  }

  Vector<double> position_, velocity_{}, spin_{};
  Vector<double> angles_;
};

}  // namespace regulus::detail::test
