// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/embedded/tracker.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

#include "counted_calls.hpp"
#include "tests/support/hostile_platforms.hpp"

namespace regulus::detail::test {
namespace {

using Point = std::array<double, 3>;

regulus_pose as_pose(const Pose<double>& pose) {
  regulus_pose result;
  std::ranges::copy(pose.position, result.position);
  std::ranges::copy(pose.rotation, result.rotation);
  return result;
}

regulus_platform as_platform(const Platform& robot) {
  regulus_platform result = {};
  for (std::size_t i = 0; i < 6; ++i) {
    std::ranges::copy(robot.base[i], result.base[i]);
    std::ranges::copy(robot.platform[i], result.platform[i]);
  }
  return result;
}

std::array<double, 6> lengths_at(const Platform& robot, const Pose<double>& pose) {
  std::array<double, 6> result;
  for (std::size_t i = 0; i < 6; ++i)
    result[i] = std::sqrt(squared_length(pose, robot.base[i], robot.platform[i]));
  return result;
}

double distance_of(const regulus_pose& a, const Pose<double>& b) {
  return std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1],
                    a.position[2] - b.position[2]);
}

double angle_of(const regulus_pose& a, const Pose<double>& b) {
  double dot = 0, norm = 0;
  for (std::size_t i = 0; i < 4; ++i)
    dot += a.rotation[i] * b.rotation[i], norm += a.rotation[i] * a.rotation[i];
  const double c = std::min(1.0, std::fabs(dot) / std::sqrt(norm));
  return 2 * std::atan2(std::sqrt(1 - c * c), c);
}

Pose<double> moved(Pose<double> pose, RandomSource& random, double by) {
  for (double& x : pose.position) x += random.between(-by, by);
  double square = 0;
  for (double& x : pose.rotation) x += random.between(-by, by), square += x * x;
  for (double& x : pose.rotation) x /= std::sqrt(square);
  return pose;
}

Point plus(const Point& a, const Point& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The point at the given distances from three others, above their plane.
Point point_at(const std::array<Point, 3>& from, const std::array<double, 3>& r) {
  const Point p = plus(from[1], from[0], -1), q = plus(from[2], from[0], -1);
  const double d = std::sqrt(dot(p, p)), i = dot(p, q) / d;
  const Point ex = plus({}, p, 1 / d);
  const Point across = plus(q, ex, -i);
  const double j = std::sqrt(dot(across, across));
  const Point ey = plus({}, across, 1 / j);
  const double x = (r[0] * r[0] - r[1] * r[1] + d * d) / (2 * d);
  const double y = (r[0] * r[0] - r[2] * r[2] + i * i + j * j - 2 * i * x) / (2 * j);
  const double z = std::sqrt(r[0] * r[0] - x * x - y * y);
  return plus(plus(plus(from[0], ex, x), ey, y), cross(ex, ey), z);
}

/// Three legs end in one point of the platform, two in another, one in a third: three tetrahedra give the
/// places of these points.
const Platform kTetrahedra{
    {{{-1, -1, 0}, {1, -1, 0}, {0, 1.2, 0}, {2, 0.3, 0}, {1.6, 1.5, 0}, {-1.5, 1.8, 0}}},
    {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}}}};

std::array<Point, 3> points_by_tetrahedra(const std::array<double, 6>& r) {
  const Anchors &a = kTetrahedra.base, &b = kTetrahedra.platform;
  const auto side = [&](std::size_t i, std::size_t k) {
    const Point gap = plus(b[i], b[k], -1);
    return std::sqrt(dot(gap, gap));
  };
  const Point first = point_at({a[0], a[1], a[2]}, {r[0], r[1], r[2]});
  const Point second = point_at({a[3], a[4], first}, {r[3], r[4], side(3, 0)});
  return {first, second, point_at({a[5], first, second}, {r[5], side(5, 0), side(5, 3)})};
}

TEST(TrackedPose, IsTheOneOfTetrahedra) {
  RandomSource random(41);
  Pose<double> at{{1, 0, 0, 0}, {0.1, -0.2, 2}};
  const regulus_platform robot = as_platform(kTetrahedra);
  // The solution of tetrahedra above their planes is this one or another.
  const auto by_pose = [](const Pose<double>& pose) {
    return std::array<Point, 3>{placed(pose, kTetrahedra.platform[0]),
                                placed(pose, kTetrahedra.platform[3]),
                                placed(pose, kTetrahedra.platform[5])};
  };
  int proved = 0, compared = 0;
  for (int step = 0; step < 200; ++step) {
    const Pose<double> last = at;
    at = moved({{1, 0, 0, 0}, {0.1, -0.2, 2}}, random, 0.0005);
    const std::array<double, 6> lengths = lengths_at(kTetrahedra, at), errors{};
    const regulus_pose from = as_pose(last);
    regulus_track_report report;
    if (regulus_track(&robot, &from, lengths.data(), errors.data(), &report) !=
        REGULUS_TRACK_ONE_POSE)
      continue;
    ++proved;
    EXPECT_LE(distance_of(report.pose, at), report.distance_error + 1e-9);
    EXPECT_LE(angle_of(report.pose, at), report.angle_error + 1e-7);
    EXPECT_LT(report.distance_error, 1e-9);
    EXPECT_LT(report.angle_error, 1e-9);
    EXPECT_LE(report.tests, unsigned(REGULUS_TRACK_MOST_TESTS));
    Pose<double> found{};
    std::copy_n(report.pose.rotation, 4, found.rotation.begin());
    std::copy_n(report.pose.position, 3, found.position.begin());
    const auto closed = points_by_tetrahedra(lengths), ours = by_pose(found);
    if (closed[0][2] * ours[0][2] < 0 || std::fabs(closed[1][2] - ours[1][2]) > 0.3) continue;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(closed[i][k], ours[i][k], 1e-8);
    ++compared;
  }
  EXPECT_GE(proved, 190);
  EXPECT_GE(compared, 100);
}

/// Newton's method with rotation matrices finds one pose near the last one, whatever the lengths are.
TEST(TrackedPose, IsTheOnlyOneForAllLengthsAndAnchors) {
  RandomSource random(42);
  int proved = 0;
  for (int round = 0; round < 60; ++round) {
    const Platform robot = Platform::random(random);
    const Pose<double> last = random_pose(random, 1.5), at = moved(last, random, 1e-3);
    const std::array<double, 6> lengths = lengths_at(robot, at);
    const double error = round % 2 == 0 ? 1e-4 : 1e-6, tolerance = round % 3 == 0 ? 1e-6 : 0;
    std::array<double, 6> errors;
    errors.fill(error);
    regulus_platform given = as_platform(robot);
    std::ranges::fill(given.base_error, tolerance);
    std::ranges::fill(given.platform_error, tolerance);
    const regulus_pose from = as_pose(last);
    regulus_track_report report;
    if (regulus_track(&given, &from, lengths.data(), errors.data(), &report) !=
        REGULUS_TRACK_ONE_POSE)
      continue;
    ++proved;
    EXPECT_GE(report.distance_radius, distance_of(from, at));
    for (int sample = 0; sample < 4; ++sample) {
      Platform actual = robot;
      for (Anchors* anchors : {&actual.base, &actual.platform})
        for (auto& anchor : *anchors)
          anchor[random.below(3)] += random.one_in(2) ? tolerance : -tolerance;
      std::array<Interval, 6> chosen;
      for (std::size_t i = 0; i < 6; ++i)
        chosen[i] = lengths[i] + error * (random.one_in(2)   ? 1
                                          : random.one_in(2) ? -1
                                                             : random.between(-1, 1));
      const GoughLegs legs = actual.with(chosen);
      const NewtonSearch newton(actual, legs);
      const auto found = newton.from(at);
      ASSERT_TRUE(found);
      EXPECT_LE(distance_of(report.pose, *found), report.distance_error * (1 + 1e-9) + 1e-9);
      EXPECT_LE(angle_of(report.pose, *found), report.angle_error * (1 + 1e-9) + 1e-7);
      for (int start = 0; start < 10; ++start) {
        const auto other = newton.from(moved(last, random, report.distance_radius));
        if (!other || distance_of(from, *other) > report.distance_radius ||
            angle_of(from, *other) > report.angle_radius)
          continue;
        EXPECT_LT(distance_of(as_pose(*found), *other), 1e-6);
        EXPECT_LT(angle_of(as_pose(*found), *other), 1e-5);
      }
    }
  }
  EXPECT_GE(proved, 15);
}

/// Nothing is claimed between two poses that are near each other, nor at a singular one.
TEST(TrackedPose, IsNotShownWhereTwoMeet) {
  // Level, and turned by a quarter: singular.
  const double s = std::sqrt(3.0);
  const Platform octahedral{
      {{{0, 10, 0}, {0, 10, 0}, {-5 * s, -5, 0}, {-5 * s, -5, 0}, {5 * s, -5, 0}, {5 * s, -5, 0}}},
      {{{3 * s, 3, 0}, {-3 * s, 3, 0}, {-3 * s, 3, 0}, {0, -6, 0}, {0, -6, 0}, {3 * s, 3, 0}}}};
  const auto turned = [](double angle) {
    return Pose<double>{{std::cos(angle / 2), 0, 0, std::sin(angle / 2)}, {0, 0, 9}};
  };
  const regulus_platform robot = as_platform(octahedral);
  const std::array<double, 6> none{};
  double radius = kInfinity;
  for (const double gap : {0.5, 0.1, 0.01, 0.0}) {
    const Pose<double> pose = turned(std::acos(-1.0) / 2 - gap);
    const regulus_pose at = as_pose(pose);
    const auto lengths = lengths_at(octahedral, pose);
    regulus_track_report report;
    const auto verdict = regulus_track(&robot, &at, lengths.data(), none.data(), &report);
    EXPECT_EQ(verdict == REGULUS_TRACK_ONE_POSE, gap > 0);
    if (gap == 0) continue;
    // Turned as far beyond the quarter, the platform has the same lengths.
    EXPECT_LT(report.angle_radius, 2 * gap);
    EXPECT_LT(report.angle_radius, radius);
    radius = report.angle_radius;
  }
}

TEST(TrackedPose, IsRefusedForBadNumbers) {
  const Pose<double> pose{{1, 0, 0, 0}, {0.1, -0.2, 2}};
  const regulus_pose at = as_pose(pose);
  const auto lengths = lengths_at(kTetrahedra, pose);
  const std::array<double, 6> none{};
  const auto verdict = [](const regulus_platform& robot, const regulus_pose& last,
                          std::array<double, 6> length, std::array<double, 6> error) {
    return regulus_track(&robot, &last, length.data(), error.data(), nullptr);
  };
  const regulus_platform robot = as_platform(kTetrahedra);
  EXPECT_EQ(verdict(robot, at, lengths, none), REGULUS_TRACK_ONE_POSE);
  for (const double bad : {std::nan(""), kInfinity, -1.0}) {
    auto length = lengths, error = none;
    length[3] = error[2] = bad;
    EXPECT_EQ(verdict(robot, at, length, none), REGULUS_TRACK_BAD_INPUT);
    EXPECT_EQ(verdict(robot, at, lengths, error), REGULUS_TRACK_BAD_INPUT);
    regulus_platform other = robot;
    other.base_error[5] = bad;
    EXPECT_EQ(verdict(other, at, lengths, none), REGULUS_TRACK_BAD_INPUT);
  }
  regulus_pose last = at;
  std::ranges::fill(last.rotation, 0.0);
  EXPECT_EQ(verdict(robot, last, lengths, none), REGULUS_TRACK_BAD_INPUT);
}

TEST(Tracking, KeepsTheRoundingAndAllocatesNothing) {
  const Pose<double> pose{{1, 0, 0, 0}, {0.1, -0.2, 2}};
  const regulus_pose at = as_pose(pose);
  const auto lengths = lengths_at(kTetrahedra, pose);
  const std::array<double, 6> errors{1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6};
  const regulus_platform robot = as_platform(kTetrahedra);
  regulus_track_report nearest, upward;
  const std::uint64_t allocated = allocations(), locked = locks();
  regulus_track(&robot, &at, lengths.data(), errors.data(), &nearest);
  EXPECT_EQ(allocations(), allocated);
  EXPECT_EQ(locks(), locked);
  std::fesetround(FE_UPWARD);
  regulus_track(&robot, &at, lengths.data(), errors.data(), &upward);
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(nearest.verdict, REGULUS_TRACK_ONE_POSE);
  EXPECT_EQ(nearest.distance_error, upward.distance_error);
  EXPECT_EQ(nearest.angle_radius, upward.angle_radius);
}

}  // namespace
}  // namespace regulus::detail::test
