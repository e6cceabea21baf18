// SPDX-License-Identifier: GPL-3.0-or-later
// Poses of platforms by a search over all rotations, against counted ones and Newton's method.
#include <gtest/gtest.h>

#include "codegen/question/solve/pose_search.hpp"
#include "tests/support/hostile_platforms.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

PoseList searched(const GoughLegs& legs, std::uint64_t max_boxes = 400'000) {
  RootSettings settings;
  settings.max_boxes = max_boxes;
  settings.boxes_after_problem = 2'000;
  return search_poses(legs, settings, nullptr);
}

Pose<double> middle(const GoughPose& pose) {
  Pose<double> result{};
  std::ranges::transform(pose.rotation, result.rotation.begin(), [](Interval q) { return mid(q); });
  std::ranges::transform(pose.position, result.position.begin(), [](Interval t) { return mid(t); });
  return result;
}

/// Both lists have the same poses.
void expect_same(const std::vector<GoughPose>& a, const std::vector<GoughPose>& b) {
  EXPECT_EQ(a.size(), b.size());
  for (const GoughPose& pose : a) EXPECT_TRUE(holds(b, middle(pose), 1e-7));
}

/// A complete list has all that Newton's method finds, the planted pose too, and certain legs.
void expect_all(const Platform& robot, const GoughLegs& legs, const Pose<double>& planted,
                const PoseList& list, RandomSource& random, int starts) {
  EXPECT_TRUE(holds(list.poses, planted, 1e-6));
  expect_nothing_missing(robot, legs, {list.poses}, random, starts);
  for (const GoughPose& pose : list.poses)
    for (std::size_t i = 0; i < 6; ++i) {
      const Interval square = squared_length<Interval>({pose.rotation, pose.position},
                                                       robot.base[i], robot.platform[i]);
      EXPECT_FALSE(certain_disjoint(square, sqr(legs.length[i])));
      EXPECT_LT(width_ru(square), 1e-4);
    }
}

TEST(PosesOfARandomPlatform, AreTheCountedOnes) {
  RandomSource random(21);
  int compared = 0;
  for (int round = 0; round < 3; ++round) {
    const Platform robot = Platform::random(random);
    const GoughLegs legs = robot.at(random_pose(random, 2));
    const GoughPoses counted = find_gough_poses(legs);
    const PoseList list = searched(legs);
    if (!counted.is_complete() || !list.is_complete) continue;
    ++compared;
    expect_same(counted.poses, list.poses);
  }
  EXPECT_GE(compared, 2);
}

/// Base and platform are flat, and each is its own image in a mirror, leg by leg.
Platform mirrored(RandomSource& random) {
  Platform robot;
  for (std::size_t i = 0; i < 3; ++i)
    for (Anchors* anchors : {&robot.base, &robot.platform}) {
      const double x = random.between(0.1, 1), y = random.between(-1, 1);
      (*anchors)[i] = {x, y, 0};
      (*anchors)[i + 3] = {-x, y, 0};
    }
  return robot;
}

/// Three pairs of legs, each the one before after a third of a turn.
Platform threefold(RandomSource& random) {
  Platform robot;
  for (Anchors* anchors : {&robot.base, &robot.platform})
    for (std::size_t i = 0; i < 2; ++i) {
      const double radius = random.between(0.4, 1), angle = random.between(-3, 3);
      for (std::size_t turn = 0; turn < 3; ++turn) {
        const double at = angle + 2 * std::acos(-1.0) / 3 * double(turn);
        (*anchors)[2 * turn + i] = {radius * std::cos(at), radius * std::sin(at), 0};
      }
    }
  return robot;
}

TEST(PosesOfAMirroredPlatform, HasNoOthers) {
  RandomSource random(22);
  int complete = 0;
  for (int round = 0; round < 5; ++round) {
    const Platform robot = mirrored(random);
    const Pose<double> planted = random_pose(random, 1);
    const GoughLegs legs = robot.at(planted);
    EXPECT_FALSE(find_gough_poses(legs).is_complete());
    const PoseList list = searched(legs);
    if (!list.is_complete) continue;
    ++complete;
    EXPECT_EQ(list.poses.size() % 4, 0U) << "a mirror, and its image below the base";
    expect_all(robot, legs, planted, list, random, 200);
  }
  EXPECT_GE(complete, 4);
}

TEST(PosesOfAThreefoldPlatform, HasNoOthers) {
  RandomSource random(23);
  int complete = 0;
  for (int round = 0; round < 4; ++round) {
    const Platform robot = threefold(random);
    const Pose<double> planted = random_pose(random, 1);
    const GoughLegs legs = robot.at(planted);
    const PoseList list = searched(legs);
    if (!list.is_complete) continue;
    ++complete;
    EXPECT_EQ(list.poses.size() % 2, 0U) << "the image below the base";
    expect_all(robot, legs, planted, list, random, 200);
  }
  EXPECT_GE(complete, 3);
}

/// Base and platform are flat and similar, one of them perhaps mirrored: the legs are linear in few of the
/// numbers that the search eliminates.
TEST(PosesOfASimilarPlatform, HasNoOthers) {
  RandomSource random(29);
  int complete = 0;
  for (int round = 0; round < 6; ++round) {
    Platform robot;
    const double size = random.between(0.3, 0.8), sign = round % 2 == 0 ? 1 : -1;
    for (std::size_t i = 0; i < 6; ++i) {
      const double angle = double(i) + random.between(0, 0.8), radius = random.between(0.7, 1);
      robot.base[i] = {radius * std::cos(angle), radius * std::sin(angle), 0};
      robot.platform[i] = {size * robot.base[i][0], sign * size * robot.base[i][1], 0};
    }
    const Pose<double> planted = random_pose(random, 1);
    const GoughLegs legs = robot.at(planted);
    const PoseList list = searched(legs);
    EXPECT_TRUE(list.is_searched);
    if (!list.is_complete) continue;
    ++complete;
    expect_all(robot, legs, planted, list, random, 200);
  }
  EXPECT_GE(complete, 4);
}

/// All anchors of the platform are on a line, about which it turns: there are infinitely many poses.
TEST(PosesOfACollinearPlatform, AreNeverAll) {
  RandomSource random(30);
  Platform robot = Platform::random(random);
  for (std::size_t i = 0; i < 6; ++i) robot.platform[i] = {random.between(-1, 1), 0, 0};
  const PoseList list = searched(robot.at(random_pose(random, 1)), 20'000);
  EXPECT_TRUE(list.is_searched);
  EXPECT_FALSE(list.is_complete);
}

/// The same platform in another frame of the base, in another chart for each pose.
TEST(PosesOfATurnedPlatform, AreAsMany) {
  RandomSource random(24);
  for (int round = 0; round < 2; ++round) {
    Platform robot = mirrored(random);
    const GoughLegs legs = robot.at(random_pose(random, 1));
    const PoseList list = searched(legs);
    const Pose<double> frame = random_pose(random, 1);
    for (auto& anchor : robot.base) anchor = placed(frame, anchor);
    const PoseList turned = searched(robot.with(legs.length));
    if (list.is_complete && turned.is_complete) {
      EXPECT_EQ(list.poses.size(), turned.poses.size());
    }
    EXPECT_TRUE(list.is_complete || turned.is_complete);
  }
}

/// A half turn and a quarter turn are on the borders of charts.
TEST(PosesOnBordersOfCharts, AreListedOnce) {
  RandomSource random(25);
  const double s = std::sqrt(0.5);
  for (const std::array<double, 4>& rotation : {std::array{s, s, 0.0, 0.0},
                                                {0.5, 0.5, 0.5, 0.5},
                                                {0.0, s, s, 0.0},
                                                {0.5, -0.5, 0.5, 0.5}}) {
    const Platform robot = Platform::random(random);
    const Pose<double> planted{rotation, {0.3, -0.2, 1.1}};
    const GoughLegs legs = robot.at(planted);
    const PoseList list = searched(legs);
    ASSERT_TRUE(list.is_complete);
    EXPECT_EQ(std::ranges::count_if(
                  list.poses, [&](const GoughPose& p) { return distance(p, planted) < 1e-6; }),
              1);
  }
}

TEST(HostilePlatforms, HaveNoFalseListOfPoses) {
  RandomSource random(26);
  int complete = 0;
  for (int round = 0; round < 8; ++round) {
    const Platform robot = hostile_platform(random);
    const Pose<double> planted = random_pose(random, 1.5);
    const GoughLegs legs = robot.at(planted);
    const PoseList list = searched(legs, 20'000);
    if (!list.is_complete) continue;
    ++complete;
    expect_all(robot, legs, planted, list, random, 60);
  }
  EXPECT_GE(complete, 1);
}

TEST(PlatformsThatMove, AreNeverComplete) {
  const Platform griffis_duffy{
      {{{-10, -6, 0}, {0, -6, 0}, {10, -6, 0}, {5, 3, 0}, {0, 12, 0}, {-5, 3, 0}}},
      {{{0, -3, 0}, {5, -3, 0}, {2.5, 1.5, 0}, {0, 6, 0}, {-2.5, 1.5, 0}, {-5, -3, 0}}}};
  RandomSource random(27);
  Pose<double> pose = random_pose(random, 3);
  pose.position[2] += 15;
  EXPECT_FALSE(searched(griffis_duffy.at(pose), 20'000).is_complete);
  EXPECT_FALSE(searched({}).is_complete);
  GoughLegs legs;
  legs.length.fill(kEntire);
  EXPECT_FALSE(searched(legs, 1'000).is_complete);
}

/// For each choice of lengths there are as many poses, each in one of the enclosures.
TEST(PosesOfUncertainLegs, AreThoseOfEachLength) {
  RandomSource random(28);
  int complete = 0;
  for (int round = 0; round < 2; ++round) {
    const Platform robot = mirrored(random);
    GoughLegs legs = robot.at(random_pose(random, 1));
    for (Interval& length : legs.length) length = length + Interval(-1e-6, 1e-6);
    const PoseList wide = searched(legs);
    if (!wide.is_complete) continue;
    ++complete;
    for (int sample = 0; sample < 2; ++sample) {
      GoughLegs exact = legs;
      for (Interval& length : exact.length) length = random.between(length.lo, length.hi);
      const PoseList at = searched(exact);
      ASSERT_EQ(at.poses.size(), wide.poses.size());
      for (const GoughPose& pose : at.poses)
        EXPECT_EQ(std::ranges::count_if(wide.poses,
                                        [&](const GoughPose& other) {
                                          return std::ranges::equal(pose.position, other.position,
                                                                    certain_subset);
                                        }),
                  1);
    }
  }
  EXPECT_GE(complete, 2);
}

/// Legs of the set `legs`, at one of its corners or inside.
GoughLegs chosen(GoughLegs legs, RandomSource& random) {
  const auto choose = [&](Interval& x) {
    x = Interval(random.one_in(3) ? x.lo : random.one_in(2) ? x.hi : random.between(x.lo, x.hi));
  };
  for (std::size_t i = 0; i < 6; ++i) {
    choose(legs.length[i]);
    for (std::size_t k = 0; k < 3; ++k) choose(legs.base[i][k]), choose(legs.platform[i][k]);
  }
  return legs;
}

/// True if the pose is in the tube, for one of the signs of its rotation.
bool is_within(const Pose<double>& pose, const GoughPose& tube) {
  const auto holds_at = [](const auto& numbers, const auto& intervals, double sign) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!contains(intervals[i] + Interval(-1e-9, 1e-9), sign * numbers[i])) return false;
    return true;
  };
  return holds_at(pose.position, tube.position, 1) &&
         (holds_at(pose.rotation, tube.rotation, 1) || holds_at(pose.rotation, tube.rotation, -1));
}

/// Whatever the legs are within the set, they have as many poses, one in each tube.
TEST(TubesOfPoses, HoldThePosesOfAllLegs) {
  RandomSource random(29);
  int complete = 0;
  for (int round = 0; round < 6; round += trials(3, 1)) {
    const Platform robot = round % 2 == 0 ? mirrored(random) : threefold(random);
    const GoughLegs at = robot.at(random_pose(random, 1));
    GoughLegs legs = at;
    const double error = round < 2 ? 1e-5 : 1e-4, tolerance = round < 4 ? 0 : 1e-6;
    for (std::size_t i = 0; i < 6; ++i) {
      legs.length[i] = legs.length[i] + Interval(-error, error);
      for (std::size_t k = 0; k < 3; ++k) {
        legs.base[i][k] = legs.base[i][k] + Interval(-tolerance, tolerance);
        legs.platform[i][k] = legs.platform[i][k] + Interval(-tolerance, tolerance);
      }
    }
    const PoseList list = searched(at);
    if (!list.is_complete) continue;
    RootSettings settings;
    settings.max_boxes = 200'000;
    const PoseTubes tubes = follow_poses(at, legs, list.poses, settings, nullptr);
    ASSERT_EQ(tubes.tubes.size(), list.poses.size());
    complete += tubes.are_all ? 1 : 0;
    for (int sample = 0; sample < 2; ++sample) {
      const PoseList other = searched(chosen(legs, random));
      if (!other.is_complete) continue;
      if (tubes.are_all) {
        EXPECT_EQ(other.poses.size(), list.poses.size());
      }
      for (const auto& tube : tubes.tubes)
        EXPECT_TRUE(!tube || std::ranges::any_of(other.poses, [&](const GoughPose& pose) {
          return is_within(middle(pose), *tube);
        }));
    }
  }
  EXPECT_GE(complete, trials(1, 2));
}

/// Legs as at a singular pose: the two poses that meet there have no tubes, and nothing is claimed of all.
TEST(TubesOfPoses, EndWhereTwoMeet) {
  // Level, and turned by a quarter about z: singular wherever it is.
  const double s = std::sqrt(3.0);
  const Platform octahedral{
      {{{0, 10, 0}, {0, 10, 0}, {-5 * s, -5, 0}, {-5 * s, -5, 0}, {5 * s, -5, 0}, {5 * s, -5, 0}}},
      {{{3 * s, 3, 0}, {-3 * s, 3, 0}, {-3 * s, 3, 0}, {0, -6, 0}, {0, -6, 0}, {3 * s, 3, 0}}}};
  const auto turned = [](double angle) {
    return Pose<double>{{std::cos(angle / 2), 0, 0, std::sin(angle / 2)}, {0, 0, 9}};
  };
  const double quarter = std::acos(-1.0) / 2;
  const GoughLegs at = octahedral.at(turned(quarter - 0.1)),
                  singular = octahedral.at(turned(quarter));
  GoughLegs legs = at;
  for (std::size_t i = 0; i < 6; ++i) legs.length[i] = hull(at.length[i], singular.length[i]);
  const PoseList list = searched(at);
  ASSERT_TRUE(list.is_complete);
  RootSettings settings;
  settings.max_boxes = 30'000;
  const PoseTubes tubes = follow_poses(at, legs, list.poses, settings, nullptr);
  EXPECT_FALSE(tubes.are_all);
  for (std::size_t i = 0; i < list.poses.size(); ++i)
    if (distance(list.poses[i], turned(quarter - 0.1)) < 1e-6) {
      EXPECT_FALSE(tubes.tubes[i]);
    }
}

}  // namespace
}  // namespace regulus::detail::test
