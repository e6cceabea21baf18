// SPDX-License-Identifier: GPL-3.0-or-later
// Linkages under a load, whose motor's torque is known in closed form by virtual work.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail::test {

/// Crank a at θ, rod b at φ to a slider at (x, e): x = a·cos θ + √(b² − (e − a·sin θ)²).
struct SliderCrank {
  double a, b, e;

  [[nodiscard]] double rise(double theta) const { return e - a * std::sin(theta); }
  [[nodiscard]] double phi(double theta) const { return std::asin(rise(theta) / b); }
  [[nodiscard]] double x(double theta) const {
    return a * std::cos(theta) + std::sqrt(b * b - rise(theta) * rise(theta));
  }
  /// dx/dθ and dφ/dθ.
  [[nodiscard]] std::pair<double, double> speeds(double theta) const {
    const double root = std::sqrt(b * b - rise(theta) * rise(theta));
    return {-a * std::sin(theta) + rise(theta) * a * std::cos(theta) / root,
            -a * std::cos(theta) / root};
  }
  [[nodiscard]] std::string text(double start, double from, double to) const {
    return fmt::format(
        "regulus = 1\nname = \"slider\"\n[pose]\ntheta = \"rad\"\n[closure]\nunknowns = {{ x = "
        "\"m\", phi = \"rad\" }}\nequations = [\"{0:.17g}*cos(theta) + {1:.17g}*cos(phi) - x\", "
        "\"{0:.17g}*sin(theta) + {1:.17g}*sin(phi) - {2:.17g}\"]\nstart = {{ theta = \"{3:.17g}\", "
        "x = \"{4:.17g}\", phi = \"{5:.17g}\" }}\n[closure.radius]\nx = \"1e-4\"\nphi = "
        "\"1e-4\"\n[motion.m]\ntheta = [\"{6:.17g}\", \"{7:.17g}\"]\n",
        a, b, e, start, x(start), phi(start), from, to);
  }
};

/// The ends of the torque over all wrenches of the load, at one angle.
using Torque = std::function<std::pair<double, double>(double theta)>;

struct LoadCase {
  std::string text;  ///< with the motion "m" from the one to the other, without limits
  double start, from, to;
  Torque torque;
};

/// [load.L] wrench = [[−1, 3], 2]: the first component has a range.
inline std::pair<double, double> of_load(double first, double second) {
  const double middle = first + 2 * second, spread = 2 * std::fabs(first);
  return {middle - spread, middle + spread};
}

inline Torque torque_of(const FourBar& bar) {
  return [bar](double theta) {
    constexpr double h = 1e-6;
    const FourBar::Angles above = bar.at(theta + h), below = bar.at(theta - h);
    const auto rate = [](double x) { return std::remainder(x, 2 * std::numbers::pi) / (2 * h); };
    return of_load(rate(above.phi - below.phi), rate(above.psi - below.psi));
  };
}

inline std::vector<LoadCase> load_cases(unsigned seed, std::size_t wanted) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(-3, 3), reach(0.1, 0.6), length(0.2, 1);
  std::vector<LoadCase> found;
  while (found.size() < wanted) {
    const FourBar bar = random_four_bar(random);
    const double start = angle(random), from = start - reach(random), to = start + reach(random);
    bool is_regular = true;
    for (int i = 0; i <= 40; ++i)
      is_regular = is_regular && bar.is_between_toggles(from + (to - from) * i / 40, 0.08);
    if (!is_regular) continue;
    found.push_back({bar.text(start, from, to), start, from, to, torque_of(bar)});
    const SliderCrank slider{length(random), 1.2 + length(random), length(random) - 0.6};
    if (slider.a + std::fabs(slider.e) > 0.9 * slider.b) continue;
    found.push_back({slider.text(start, from, to), start, from, to, [slider](double theta) {
                       const auto [x, phi] = slider.speeds(theta);
                       return of_load(x, phi);
                     }});
  }
  return found;
}

inline std::string with_limits(const LoadCase& c, double least, double largest) {
  return c.text + fmt::format(
                      "[actuators]\nforce = [\"{:.17g}\", \"{:.17g}\"]\n[load.L]\nwrench = "
                      "[[-1, 3], 2]\n",
                      least, largest);
}

}  // namespace regulus::detail::test
