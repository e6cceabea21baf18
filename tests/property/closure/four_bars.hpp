// SPDX-License-Identifier: GPL-3.0-or-later
// Four-bar linkages, whose configurations and toggles are known in closed form.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace regulus::detail::test {

/// Crank a from (0, 0) at θ, coupler b at φ, rocker c at ψ from (d, 0).
struct FourBar {
  double a, b, c, d;
  bool is_open = true;  ///< of the two assemblies, that with the larger φ

  struct Angles {
    double phi, psi;
  };
  [[nodiscard]] double diagonal(double theta) const {
    return std::hypot(d - a * std::cos(theta), a * std::sin(theta));
  }
  /// The linkage is singular where coupler and rocker are in line.
  [[nodiscard]] bool is_between_toggles(double theta, double room = 0) const {
    const double s = diagonal(theta);
    return s > std::fabs(b - c) + room && s < b + c - room;
  }
  /// Requires  is_between_toggles(theta).
  [[nodiscard]] Angles at(double theta) const {
    const double s = diagonal(theta);
    const double to_pivot = std::atan2(-a * std::sin(theta), d - a * std::cos(theta));
    const double bend = std::acos(std::clamp((b * b + s * s - c * c) / (2 * b * s), -1.0, 1.0));
    const double phi = to_pivot + (is_open ? bend : -bend);
    const double x = a * std::cos(theta) + b * std::cos(phi) - d;
    const double y = a * std::sin(theta) + b * std::sin(phi);
    return {phi, std::atan2(y, x)};
  }

  /// The model, whose motion goes through `start`.
  [[nodiscard]] std::string text(double start, double from, double to, double tolerance = 0) const {
    const Angles angles = at(start);
    return fmt::format(
        "regulus = 1\nname = \"four-bar\"\n[pose]\ntheta = \"rad\"\n[geometry]\n"
        "a = {{ value = \"{:.17g}\", tolerance = \"{:.17g}\", group = \"links\" }}\n"
        "b = {{ value = \"{:.17g}\", tolerance = \"{:.17g}\", group = \"links\" }}\n"
        "c = \"{:.17g}\"\nd = \"{:.17g}\"\n[closure]\nunknowns = {{ phi = \"rad\", psi = \"rad\" "
        "}}\nequations = [\"a*cos(theta) + b*cos(phi) - d - c*cos(psi)\", \"a*sin(theta) + "
        "b*sin(phi) - c*sin(psi)\"]\nstart = {{ theta = \"{:.17g}\", phi = \"{:.17g}\", psi = "
        "\"{:.17g}\" }}\n[closure.radius]\nphi = \"1e-4\"\npsi = \"1e-4\"\n[motion.m]\ntheta = "
        "[\"{:.17g}\", \"{:.17g}\"]\n",
        a, tolerance, b, tolerance, c, d, start, angles.phi, angles.psi, from, to);
  }
};

inline FourBar random_four_bar(std::mt19937& random) {
  std::uniform_real_distribution<double> length(0.2, 2);
  return {length(random), length(random), length(random), length(random), random() % 2 == 0};
}

}  // namespace regulus::detail::test
