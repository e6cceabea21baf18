// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// A hexapod with its anchors in three pairs on two circles, at a random pose.
class RandomHexapod {
 public:
  explicit RandomHexapod(RandomSource& random) {
    const double radius = random.between(100, 200);
    place(base_, radius, random.between(0.05, 0.4));
    place(platform_, radius * random.between(0.4, 0.8),
          std::numbers::pi / 3 - random.between(0.05, 0.4));
    for (double& x : pose_) x = random.between(-0.3, 0.3);
    pose_[2] = random.between(1.2, 2.5);
    for (int i = 0; i < 3; ++i) pose_[i] *= radius;
  }

  /// Moves the anchors to a place from which a singularity at the pose is as far as that part of
  /// the tolerance, in the direction in which the determinant falls fastest. Returns false for a
  /// robot that this does not suit.
  [[nodiscard]] bool plant_singularity(double tolerance, double part, bool ball) {
    double& z = platform_[5][2];
    const double at_zero = determinant();
    z = 1;
    const double slope = determinant() - at_zero;  // the determinant is linear in an anchor
    z = -at_zero / slope;
    if (!(std::fabs(z) < 100)) return false;
    std::array<Point, 12> away{};
    for (int i = 0; i < 12; ++i) away[i] = step_from_zero(anchor(i), tolerance * part, ball);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 3; ++j) anchor(i)[j] += away[i][j];
    return true;
  }

  /// Returns a model with the motions "pose", and "box" and "path", which contain that pose.
  [[nodiscard]] std::string model(double tolerance, const char* shape) const {
    std::string text = fmt::format(
        "regulus = 1\nname = \"hexapod\"\n[gough]\norientation = \"roll-pitch-yaw\"\n"
        "unit = \"mm\"\nbase = [{1}]\nplatform = [{2}]\nbase_tolerance = {0:.17g}\n"
        "platform_tolerance = {0:.17g}\ntolerance_shape = \"{3}\"\n",
        tolerance, list(base_), list(platform_), shape);
    constexpr const char* kNames[] = {"x", "y", "z", "roll", "pitch", "yaw"};
    text += "[motion.pose]\n";
    for (int i = 0; i < 6; ++i) text += fmt::format("{} = {:.17g}\n", kNames[i], pose_[i]);
    text += "[motion.box]\n";
    for (int i = 0; i < 6; ++i) {
      const double half = i < 3 ? 1.0 : 0.01;
      text += fmt::format("{} = [{:.17g}, {:.17g}]\n", kNames[i], pose_[i] - half, pose_[i] + half);
    }
    text += "[motion.path]\nparameters = { s = [0, 1] }\n";
    for (int i = 0; i < 6; ++i)
      text += fmt::format("{} = \"({:.17g}) + ({})*(s - 1/3)\"\n", kNames[i], pose_[i],
                          i < 3 ? i - 1.5 : 0.01 * (i - 4));
    return text;
  }

 private:
  using Point = std::array<double, 3>;
  using Anchors = std::array<Point, 6>;

  static void place(Anchors& anchors, double radius, double half_angle) {
    for (int i = 0; i < 6; ++i) {
      const double angle =
          2 * std::numbers::pi / 3 * (i / 2) + (i % 2 == 0 ? -half_angle : half_angle);
      anchors[i] = {radius * std::cos(angle), radius * std::sin(angle), 0};
    }
  }
  static std::string list(const Anchors& anchors) {
    std::string text;
    for (const Point& p : anchors)
      text +=
          fmt::format("{}[{:.17g}, {:.17g}, {:.17g}]", text.empty() ? "" : ", ", p[0], p[1], p[2]);
    return text;
  }

  [[nodiscard]] Point& anchor(int i) { return i < 6 ? base_[i] : platform_[i - 6]; }

  /// Returns R·b, R = Rz(yaw)·Ry(pitch)·Rx(roll).
  [[nodiscard]] Point rotated(const Point& b) const {
    const auto turn = [](double& a, double& c, double angle) {
      const double first = std::cos(angle) * a - std::sin(angle) * c;
      c = std::sin(angle) * a + std::cos(angle) * c;
      a = first;
    };
    Point p = b;
    turn(p[1], p[2], pose_[3]);
    turn(p[2], p[0], pose_[4]);
    turn(p[0], p[1], pose_[5]);
    return p;
  }

  /// Returns det of the rows (AB, RB × AB), to nearest.
  [[nodiscard]] double determinant() const {
    double M[6][6];
    for (int i = 0; i < 6; ++i) {
      const Point r = rotated(platform_[i]);
      double* row = M[i];
      for (int j = 0; j < 3; ++j) row[j] = pose_[j] + r[j] - base_[i][j];
      for (int j = 0; j < 3; ++j)
        row[3 + j] = r[(j + 1) % 3] * row[(j + 2) % 3] - r[(j + 2) % 3] * row[(j + 1) % 3];
    }
    double result = 1;
    for (int k = 0; k < 6; ++k) {
      int pivot = k;
      for (int i = k + 1; i < 6; ++i)
        if (std::fabs(M[i][k]) > std::fabs(M[pivot][k])) pivot = i;
      if (pivot != k) std::swap(M[pivot], M[k]), result = -result;
      result *= M[k][k];
      for (int i = k + 1; i < 6; ++i)
        for (int j = 5; j >= k; --j) M[i][j] -= M[i][k] / M[k][k] * M[k][j];
    }
    return result;
  }

  /// Returns the step of an anchor along the gradient of the determinant, of that length, or with
  /// coordinates of that size.
  [[nodiscard]] Point step_from_zero(Point& p, double length, bool ball) {
    Point gradient{};
    for (int j = 0; j < 3; ++j) {
      const Point before = p;
      p[j] = before[j] + 1;
      gradient[j] = determinant();
      p[j] = before[j] - 1;
      gradient[j] -= determinant();
      p = before;
    }
    const double norm = std::hypot(gradient[0], gradient[1], gradient[2]);
    for (double& g : gradient) g = length * (ball ? g / norm : g < 0 ? -1.0 : 1.0);
    return gradient;
  }

  Anchors base_, platform_;
  double pose_[6];  ///< x y z roll pitch yaw; mm and rad
};

}  // namespace regulus::detail::test
