// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/random_source.hpp"

namespace regulus::test {

/// A hexapod with its anchors in three pairs on two circles, at a random pose.
struct RandomHexapod {
  std::string base, platform;  ///< lists of anchors, as a model file has them
  double pose[6];              ///< x y z roll pitch yaw; mm and rad

  explicit RandomHexapod(RandomSource& random) {
    const double radius = random.between(100, 200);
    base = anchors(radius, random.between(0.05, 0.4), 0);
    platform =
        anchors(radius * random.between(0.4, 0.8), random.between(0.05, 0.4), std::numbers::pi / 3);
    for (int i = 0; i < 3; ++i) pose[i] = random.between(-0.3, 0.3) * radius;
    pose[2] = random.between(1.2, 2.5) * radius;
    for (int i = 3; i < 6; ++i) pose[i] = random.between(-0.3, 0.3);
  }

  /// Returns a model with the motions "pose" and "box", which contains that pose.
  [[nodiscard]] std::string model(double tolerance, const char* shape) const {
    std::string text = fmt::format(
        "regulus = 1\nname = \"hexapod\"\n[gough]\norientation = \"roll-pitch-yaw\"\n"
        "unit = \"mm\"\nbase = [{1}]\nplatform = [{2}]\nbase_tolerance = "
        "{0:.17g}\nplatform_tolerance = {0:.17g}\n"
        "tolerance_shape = \"{3}\"\n",
        tolerance, base, platform, shape);
    constexpr const char* kNames[] = {"x", "y", "z", "roll", "pitch", "yaw"};
    text += "[motion.pose]\n";
    for (int i = 0; i < 6; ++i) text += fmt::format("{} = {:.17g}\n", kNames[i], pose[i]);
    text += "[motion.box]\n";
    for (int i = 0; i < 6; ++i) {
      const double half = i < 3 ? 1.0 : 0.01;
      text += fmt::format("{} = [{:.17g}, {:.17g}]\n", kNames[i], pose[i] - half, pose[i] + half);
    }
    return text;
  }

 private:
  static std::string anchors(double radius, double half_angle, double turn) {
    std::string list;
    for (int pair = 0; pair < 3; ++pair)
      for (const double side : {-1.0, 1.0}) {
        // The platform's pairs lie between those of the base; its first anchor belongs to the last.
        const double angle = turn == 0
                                 ? 2 * std::numbers::pi / 3 * pair + side * half_angle
                                 : 2 * std::numbers::pi / 3 * pair + side * (turn - half_angle);
        list += fmt::format("{}[{:.6f}, {:.6f}, 0]", list.empty() ? "" : ", ",
                            radius * std::cos(angle), radius * std::sin(angle));
      }
    return list;
  }
};

}  // namespace regulus::test
