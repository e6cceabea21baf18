// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/solutions/gough_poses.hpp"

#include <gtest/gtest.h>

#include "runtime/solutions/dietmaier.hpp"
#include "tests/support/hostile_platforms.hpp"

namespace regulus::detail::test {
namespace {

/// Each pose encloses one with these legs, as far as rotation matrices can tell.
void expect_legs(const Platform& robot, const GoughLegs& legs, const GoughPoses& found) {
  for (const GoughPose& pose : found.poses)
    for (std::size_t i = 0; i < 6; ++i) {
      const Interval square = squared_length<Interval>({pose.rotation, pose.position},
                                                       robot.base[i], robot.platform[i]);
      EXPECT_FALSE(certain_disjoint(square, sqr(legs.length[i])));
      EXPECT_LT(width_ru(square), 1e-4);
    }
}

TEST(DietmaiersPlatform, HasForty) {
  const Platform robot{dietmaier::kBase, dietmaier::kPlatform};
  std::array<Interval, 6> length;
  std::ranges::copy(dietmaier::kLength, length.begin());
  const GoughPoses found = find_gough_poses(robot.with(length));
  EXPECT_TRUE(found.is_complete());
  ASSERT_EQ(found.poses.size(), 40U);
  expect_legs(robot, robot.with(length), found);
  for (const auto& known : dietmaier::kPoses)
    EXPECT_TRUE(holds(found.poses,
                      {{known[3], known[4], known[5], known[6]}, {known[0], known[1], known[2]}},
                      1e-9));
}

TEST(ARandomHexapod, HasAllItsPosesInTheList) {
  RandomSource random(3);
  int complete = 0;
  for (int round = 0; round < 30; ++round) {
    const Platform robot = Platform::random(random);
    const Pose<double> planted = random_pose(random, 2);
    const GoughLegs legs = robot.at(planted);
    const GoughPoses found = find_gough_poses(legs);
    EXPECT_LE(found.complex, 40U);
    expect_legs(robot, legs, found);
    if (!found.is_complete()) continue;
    ++complete;
    EXPECT_TRUE(holds(found.poses, planted, 1e-6));
    expect_nothing_missing(robot, legs, found, random, 100);
  }
  EXPECT_GE(complete, 28);
}

/// A random platform whose legs meet in pairs, in a random order, at the platform or at the base.
TEST(LegsThatMeetInPairs, HaveAllTheirPosesInTheList) {
  RandomSource random(7);
  int complete = 0;
  for (int round = 0; round < 20; ++round) {
    Platform robot = Platform::random(random);
    std::array<std::size_t, 6> points{0, 0, 1, 1, 2, 2};
    for (std::size_t i = 5; i > 0; --i) std::swap(points[i], points[random.below(i + 1)]);
    const bool at_base = random.one_in(2);
    Anchors& anchors = at_base ? robot.base : robot.platform;
    const Anchors all = anchors;
    for (std::size_t i = 0; i < 6; ++i) anchors[i] = all[points[i]];
    const Pose<double> planted = random_pose(random, 1.5);
    GoughLegs legs = robot.at(planted);
    const GoughPoses general = find_gough_poses(legs);
    EXPECT_LE(general.complex, 16U);
    (at_base ? legs.base_point : legs.platform_point) = points;
    const GoughPoses found = find_gough_poses(legs);
    EXPECT_LE(found.complex, 16U);
    EXPECT_EQ(found.most, 16U);
    expect_legs(robot, legs, found);
    if (!found.is_complete()) continue;
    ++complete;
    EXPECT_LE(general.poses.size(), found.poses.size());
    EXPECT_TRUE(holds(found.poses, planted, 1e-6));
    expect_nothing_missing(robot, legs, found, random, 100);
  }
  EXPECT_GE(complete, 18);
}

TEST(HostilePlatforms, AreNeverFalselyComplete) { expect_no_false_list_of_poses(8, 20); }

TEST(UncertainLegs, AreProvedForAllTheirLengths) {
  RandomSource random(4);
  int complete = 0;
  for (int round = 0; round < 10; ++round) {
    const Platform robot = Platform::random(random);
    GoughLegs legs = robot.at(random_pose(random, 2));
    for (Interval& length : legs.length) length = length + Interval(-1e-6, 1e-6);
    const GoughPoses found = find_gough_poses(legs);
    if (!found.is_complete()) continue;
    ++complete;
    for (int sample = 0; sample < 5; ++sample) {
      GoughLegs exact = legs;
      for (Interval& length : exact.length) length = random.between(length.lo, length.hi);
      const GoughPoses at = find_gough_poses(exact);
      ASSERT_EQ(at.poses.size(), found.poses.size());
      for (const GoughPose& pose : at.poses)
        EXPECT_TRUE(std::ranges::any_of(found.poses, [&](const GoughPose& wide) {
          return std::ranges::equal(pose.position, wide.position,
                                    [](Interval a, Interval b) { return !certain_disjoint(a, b); });
        }));
    }
  }
  EXPECT_GE(complete, 5);
}

/// Of the lines of the legs.
double determinant(const Platform& robot, const Pose<double>& pose) {
  std::vector<double> matrix;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto end = placed(pose, robot.platform[i]);
    std::array<double, 3> u, r;
    for (std::size_t k = 0; k < 3; ++k)
      u[k] = end[k] - robot.base[i][k], r[k] = end[k] - pose.position[k];
    matrix.insert(matrix.end(), {u[0], u[1], u[2], r[1] * u[2] - r[2] * u[1],
                                 r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]});
  }
  double product = 1;  // by elimination
  for (std::size_t c = 0; c < 6; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c; i < 6; ++i)
      if (std::abs(matrix[i * 6 + c]) > std::abs(matrix[pivot * 6 + c])) pivot = i;
    if (pivot != c) product = -product;
    for (std::size_t j = 0; j < 6; ++j) std::swap(matrix[c * 6 + j], matrix[pivot * 6 + j]);
    product *= matrix[c * 6 + c];
    for (std::size_t i = c + 1; i < 6; ++i)
      for (std::size_t j = 6; j-- > c;)
        matrix[i * 6 + j] -= matrix[i * 6 + c] / matrix[c * 6 + c] * matrix[c * 6 + j];
  }
  return product;
}

/// Legs between the lengths at two poses: if the matrix changes its sign between these, two poses of
/// some platform enclosed are one, and no number of simple poses is 40.
TEST(LegsThatEncloseADoublePose, AreNeverComplete) {
  RandomSource random(5);
  int singular = 0;
  for (int round = 0; round < 40; ++round) {
    const Platform robot = Platform::random(random);
    const Pose<double> at = random_pose(random, 1);
    const auto moved = [&](double x) {
      Pose<double> pose = at;
      pose.position[0] = x;
      return determinant(robot, pose);
    };
    double left = -2, right = 2;
    if (moved(left) * moved(right) >= 0) continue;
    while (right - left > 1e-9) {
      const double middle = (left + right) / 2;
      (moved(middle) * moved(left) > 0 ? left : right) = middle;
    }
    Pose<Interval> between;
    std::ranges::copy(at.rotation, between.rotation.begin());
    std::ranges::copy(at.position, between.position.begin());
    between.position[0] = {left, right};
    std::array<Interval, 6> length;
    for (std::size_t i = 0; i < 6; ++i)
      length[i] =
          sqrt(squared_length(between, robot.base[i], robot.platform[i]) + Interval(-1e-12, 1e-12));
    ++singular;
    EXPECT_FALSE(find_gough_poses(robot.with(length)).is_complete());
  }
  EXPECT_GE(singular, 10);
}

TEST(SpecialPlatforms, AreNeverComplete) {
  const double s = std::sqrt(3.0);
  const Platform similar{
      {{{24, 7, 0}, {7, 24, 0}, {-15, 20, 0}, {-24, -7, 0}, {0, -25, 0}, {20, -15, 0}}},
      {{{12, 3.5, 0}, {3.5, 12, 0}, {-7.5, 10, 0}, {-12, -3.5, 0}, {0, -12.5, 0}, {10, -7.5, 0}}}};
  const Platform griffis_duffy{
      {{{-10, -6, 0}, {0, -6, 0}, {10, -6, 0}, {5, 3, 0}, {0, 12, 0}, {-5, 3, 0}}},
      {{{0, -3, 0}, {5, -3, 0}, {2.5, 1.5, 0}, {0, 6, 0}, {-2.5, 1.5, 0}, {-5, -3, 0}}}};
  const Platform octahedral{
      {{{0, 10, 0}, {0, 10, 0}, {-5 * s, -5, 0}, {-5 * s, -5, 0}, {5 * s, -5, 0}, {5 * s, -5, 0}}},
      {{{3 * s, 3, 0}, {-3 * s, 3, 0}, {-3 * s, 3, 0}, {0, -6, 0}, {0, -6, 0}, {3 * s, 3, 0}}}};
  RandomSource random(6);
  for (const Platform& robot : {similar, griffis_duffy, octahedral})
    for (int round = 0; round < 3; ++round) {
      Pose<double> pose = random_pose(random, 3);
      pose.position[2] += 15;
      EXPECT_FALSE(find_gough_poses(robot.at(pose)).is_complete());
    }
}

TEST(AnEmptyPlatform, IsNotComplete) {
  EXPECT_FALSE(find_gough_poses({}).is_complete());
  GoughLegs legs;
  legs.length.fill(kEntire);
  EXPECT_FALSE(find_gough_poses(legs).is_complete());
}

}  // namespace
}  // namespace regulus::detail::test
