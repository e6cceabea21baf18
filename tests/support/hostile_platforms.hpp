// SPDX-License-Identifier: GPL-3.0-or-later
// Judges lists of poses: by Newton's method, and by the same platform seen from another frame.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "runtime/existence/branch_tube.hpp"
#include "tests/support/platforms.hpp"

namespace regulus::detail::test {

inline bool holds(const std::vector<GoughPose>& poses, const Pose<double>& pose, double tolerance) {
  return std::ranges::any_of(
      poses, [&](const GoughPose& known) { return distance(known, pose) < tolerance; });
}

/// Newton's method with lengths, positions and rotations by small turns.
class NewtonSearch {
 public:
  NewtonSearch(const Platform& robot, const GoughLegs& legs) : robot_(robot), legs_(legs) {}

  [[nodiscard]] std::optional<Pose<double>> from(Pose<double> pose) const {
    for (int step = 0; step < 60; ++step) {
      const auto now = errors(pose);
      if (std::ranges::all_of(now, [](double e) { return std::abs(e) < 1e-13; })) return pose;
      std::vector<double> matrix(36);
      for (std::size_t k = 0; k < 6; ++k) {
        const auto moved = errors(changed(pose, k, 1e-7));
        for (std::size_t i = 0; i < 6; ++i) matrix[i * 6 + k] = (moved[i] - now[i]) / 1e-7;
      }
      const auto inverse = approx_inverse_of(matrix, 6);
      if (!inverse) return std::nullopt;
      std::array<double, 6> by{};
      double largest = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t i = 0; i < 6; ++i) by[k] -= (*inverse)[k * 6 + i] * now[i];
        largest = std::max(largest, std::abs(by[k]));
      }
      for (std::size_t k = 0; k < 6; ++k)
        pose = changed(pose, k, by[k] * std::min(1.0, 0.5 / largest));
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::array<double, 6> errors(const Pose<double>& pose) const {
    std::array<double, 6> result{};
    for (std::size_t i = 0; i < 6; ++i)
      result[i] = squared_length(pose, robot_.base[i], robot_.platform[i]) -
                  legs_.length[i].lo * legs_.length[i].lo;
    return result;
  }

  static Pose<double> changed(Pose<double> pose, std::size_t k, double by) {
    if (k < 3) {
      pose.position[k] += by;
      return pose;
    }
    const auto [w, x, y, z] = pose.rotation;
    const std::array<std::array<double, 4>, 3> turns{
        {{-x, w, -z, y}, {-y, z, w, -x}, {-z, -y, x, w}}};
    double square = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      pose.rotation[i] += by / 2 * turns[k - 3][i];
      square += pose.rotation[i] * pose.rotation[i];
    }
    for (double& q : pose.rotation) q /= std::sqrt(square);
    return pose;
  }

  const Platform& robot_;
  const GoughLegs& legs_;
};

/// Nothing that Newton's method finds is missing in a list that is complete.
inline void expect_nothing_missing(const Platform& robot, const GoughLegs& legs,
                                   const GoughPoses& found, RandomSource& random, int starts) {
  const NewtonSearch search(robot, legs);
  for (int start = 0; start < starts; ++start) {
    const auto pose = search.from(random_pose(random, 3));
    EXPECT_TRUE(!pose || holds(found.poses, *pose, 1e-5));
  }
}

/// A platform of few different small numbers: anchors that coincide, or are in a line or a plane, and
/// platforms like the base.
inline Platform hostile_platform(RandomSource& random) {
  Platform robot;
  const std::uint64_t numbers = 2 + random.below(4);
  const bool is_flat = random.one_in(2);
  for (Anchors* anchors : {&robot.base, &robot.platform})
    for (auto& anchor : *anchors) {
      for (double& x : anchor)
        x = static_cast<double>(random.below(numbers)) / 2 + (random.one_in(9) ? 1e-8 : 0);
      if (is_flat) anchor[2] = 0;
    }
  if (random.one_in(4))
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        robot.platform[i][k] = robot.base[i][(k + random.below(2)) % 3] / 2;
  return robot;
}

/// The number of an anchor among those that are equal to it.
inline std::array<std::size_t, 6> points_of(const Anchors& anchors) {
  std::array<std::size_t, 6> points{};
  for (std::size_t i = 0; i < 6; ++i)
    points[i] = static_cast<std::size_t>(std::ranges::find(anchors, anchors[i]) - anchors.begin());
  return points;
}

/// Ensures   a list that is said to be complete holds all that Newton's method finds, and is as long
///           as the complete list of the same platform with its base turned and moved.
inline void expect_no_false_list_of_poses(std::uint64_t seed, int cases) {
  RandomSource random(seed);
  int complete = 0;
  for (int round = 0; round < cases; ++round) {
    Platform robot = hostile_platform(random);
    if (round % 3 == 0) {
      const Platform regular = Platform::random(random);
      (round % 2 == 0 ? robot.base : robot.platform) = regular.base;
    }
    GoughLegs legs = robot.at(random_pose(random, 1.5));
    legs.base_point = points_of(robot.base), legs.platform_point = points_of(robot.platform);
    const GoughPoses found = find_gough_poses(legs);
    ASSERT_LE(found.complex, found.most) << "case " << round;
    if (!found.is_complete()) continue;
    ++complete;
    expect_nothing_missing(robot, legs, found, random, 40);
    const Pose<double> frame = random_pose(random, 1);
    Platform moved = robot;
    for (auto& anchor : moved.base) anchor = placed(frame, anchor);
    GoughLegs again = moved.with(legs.length);
    again.base_point = legs.base_point, again.platform_point = legs.platform_point;
    const GoughPoses other = find_gough_poses(again);
    EXPECT_TRUE(!other.is_complete() || other.poses.size() == found.poses.size())
        << "case " << round << ": " << found.poses.size() << ", " << other.poses.size();
  }
  EXPECT_GE(complete, cases / 10);
  EXPECT_LE(complete, cases);
}

}  // namespace regulus::detail::test
