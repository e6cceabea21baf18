// SPDX-License-Identifier: GPL-3.0-or-later
// Gough platforms by rotation matrices, which the counting of poses does not use.
#pragma once

#include <cmath>

#include "runtime/solutions/gough_poses.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

using Anchors = std::array<std::array<double, 3>, 6>;

template <class Number>
struct Pose {
  std::array<Number, 4> rotation;  ///< unit quaternion
  std::array<Number, 3> position;
};

inline Pose<double> random_pose(RandomSource& random, double distance) {
  Pose<double> pose{};
  double square = 0;
  for (double& q : pose.rotation) q = random.between(-1, 1), square += q * q;
  for (double& q : pose.rotation) q /= std::sqrt(square);
  for (double& t : pose.position) t = distance * random.between(-1, 1);
  return pose;
}

template <class Number>
std::array<Number, 3> placed(const Pose<Number>& pose, const std::array<double, 3>& b) {
  const auto& [w, x, y, z] = pose.rotation;
  const Number two(2.0), one(1.0);
  const std::array<std::array<Number, 3>, 3> turn{
      {{one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)},
       {two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)},
       {two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)}}};
  std::array<Number, 3> result = pose.position;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j) result[k] = result[k] + turn[k][j] * Number(b[j]);
  return result;
}

template <class Number>
Number squared_length(const Pose<Number>& pose, const std::array<double, 3>& a,
                      const std::array<double, 3>& b) {
  const auto end = placed(pose, b);
  Number sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) sum = sum + (end[k] - Number(a[k])) * (end[k] - Number(a[k]));
  return sum;
}

struct Platform {
  Anchors base{}, platform{};

  static Platform random(RandomSource& random) {
    Platform result;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        result.base[i][k] = random.between(-1, 1), result.platform[i][k] = random.between(-1, 1);
    return result;
  }

  [[nodiscard]] GoughLegs with(const std::array<Interval, 6>& length) const {
    GoughLegs legs{{}, {}, length};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        legs.base[i][k] = base[i][k], legs.platform[i][k] = platform[i][k];
    return legs;
  }

  [[nodiscard]] GoughLegs at(const Pose<double>& pose) const {
    std::array<Interval, 6> length;
    for (std::size_t i = 0; i < 6; ++i)
      length[i] = std::sqrt(squared_length(pose, base[i], platform[i]));
    return with(length);
  }
};

/// How far q and −q, whichever is nearer, and t are from a certain pose; by the largest part.
inline double distance(const GoughPose& a, const Pose<double>& b) {
  double moved = 0, same = 0, opposite = 0;
  for (std::size_t k = 0; k < 3; ++k)
    moved = std::max(moved, std::abs(mid(a.position[k]) - b.position[k]));
  for (std::size_t k = 0; k < 4; ++k) {
    same = std::max(same, std::abs(mid(a.rotation[k]) - b.rotation[k]));
    opposite = std::max(opposite, std::abs(mid(a.rotation[k]) + b.rotation[k]));
  }
  return std::max(moved, std::min(same, opposite));
}

}  // namespace regulus::detail::test
