// SPDX-License-Identifier: GPL-3.0-or-later
// A platform on three legs in the plane, whose poses are counted on a grid of angles.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace regulus::detail::test {

/// A planar platform on three legs by its anchors.
struct PlanarPlatform {
  std::array<std::array<double, 2>, 3> base, platform;
  std::array<double, 3> legs;

  [[nodiscard]] std::array<double, 3> legs_at(double x, double y, double phi) const {
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [u, v] = point(i, phi);
      lengths[i] = std::hypot(x + u, y + v);
    }
    return lengths;
  }

  /// The poses, by the angle: the differences of the equations are linear in x and y, and a root of
  /// the rest is between two angles of a fine grid. Negative: two roots may be between two of them.
  [[nodiscard]] int count(int steps = 200'000) const {
    int roots = 0;
    double before = rest(0), before_that = rest(-2 * std::numbers::pi / steps);
    for (int i = 1; i <= steps; ++i) {
      const double now = rest(2 * std::numbers::pi * i / steps);
      if ((now < 0) != (before < 0)) ++roots;
      const bool touches = std::fabs(before) < std::fabs(now) &&
                           std::fabs(before) < std::fabs(before_that) &&
                           (now < 0) == (before < 0) && (before_that < 0) == (before < 0);
      if (touches && std::fabs(before) < 10 * std::fabs(now - before)) return -1;
      before_that = before, before = now;
    }
    return roots;
  }

 private:
  /// From an anchor of the base to that of the platform at the origin.
  [[nodiscard]] std::array<double, 2> point(std::size_t i, double phi) const {
    const double c = std::cos(phi), s = std::sin(phi);
    return {platform[i][0] * c - platform[i][1] * s - base[i][0],
            platform[i][0] * s + platform[i][1] * c - base[i][1]};
  }

  /// The first equation times the square of the determinant of the other two, at their x and y.
  [[nodiscard]] double rest(double phi) const {
    std::array<double, 3> u{}, v{}, w{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = point(i, phi);
      u[i] = a, v[i] = b, w[i] = a * a + b * b - legs[i] * legs[i];
    }
    const double a1 = 2 * (u[1] - u[0]), b1 = 2 * (v[1] - v[0]), c1 = w[0] - w[1];
    const double a2 = 2 * (u[2] - u[0]), b2 = 2 * (v[2] - v[0]), c2 = w[0] - w[2];
    const double det = a1 * b2 - a2 * b1, x = c1 * b2 - c2 * b1, y = a1 * c2 - a2 * c1;
    return x * x + y * y + 2 * det * (u[0] * x + v[0] * y) + w[0] * det * det;
  }
};

}  // namespace regulus::detail::test
