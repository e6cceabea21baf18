// SPDX-License-Identifier: GPL-3.0-or-later
// Arms with joints that follow others, in doubles and as text; random ones; and the postures that are to be
// in their lists. Nothing of it is from the code under test.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "tests/property/solve/tubes.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test::coupled_arms {

struct Joint {
  Vec xyz{};
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< of any length
  Vec axis{0, 0, 1};
  bool slides = false;
  std::optional<std::size_t> leader{};  ///< a number among those that follow none
  double multiplier = 1, offset = 0;
  double turns =
      1;  ///< of one that follows none: after so many all that it moves is as before; 0: never
};
using Arm = std::vector<Joint>;

/// Joints that no number of turns brings back have this range.
constexpr double kRange = 1.5;

inline Mat rotation_of(const std::array<double, 4>& q) {
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  Mat R;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double turned = i == j             ? q[0] * q[0] - 0.5 * square
                            : (i + 1) % 3 == j ? -q[0] * q[4 - i - j]
                                               : q[0] * q[4 - i - j];
      R[i][j] = 2 * (q[i + 1] * q[j + 1] + turned) / square;
    }
  return R;
}

inline Frame end_of(const Arm& arm, const Numbers& q) {
  Frame frame;
  std::size_t next = 0;
  for (const Joint& joint : arm) {
    const double value =
        joint.leader ? joint.multiplier * q[*joint.leader] + joint.offset : q[next++];
    const double length = std::sqrt(inner(joint.axis, joint.axis));
    frame = frame * Frame{rotation_of(joint.quaternion), joint.xyz} *
            (joint.slides ? Frame{.p = value / length * joint.axis}
                          : Frame{.R = turn_about(joint.axis, value)});
  }
  return frame;
}

template <std::size_t n>
std::string list(const std::array<double, n>& values) {
  return fmt::format("[{:.17g}]", fmt::join(values, ", "));
}

/// `range`: of the joints that are not the same after some turns; 0: none is given.
inline std::string text_of(const Arm& arm, const Numbers& q, double range = 0) {
  std::string joints, motion;
  std::size_t next = 0;
  for (const Joint& joint : arm) {
    std::string words;
    if (joint.leader) {
      words = fmt::format("mimic = \"q{}\", multiplier = {:.17g}, offset = {:.17g}",
                          *joint.leader + 1, joint.multiplier, joint.offset);
    } else {
      motion += fmt::format("q{} = {:.17g}\n", next + 1, q[next]);
      words = fmt::format("name = \"q{}\"", ++next);
      const double most = joint.slides || joint.turns == 0 ? range : 7;
      if (range > 0) words += fmt::format(", range = [{}, {}]", -most, most);
    }
    joints += fmt::format("{{ {}, type = \"{}\", xyz = {}, quaternion = {}, axis = {} }},\n", words,
                          joint.slides ? "prismatic" : "revolute", list(joint.xyz),
                          list(joint.quaternion), list(joint.axis));
  }
  return fmt::format("regulus = 1\nname = \"arm\"\n[serial]\njoints = [\n{}]\n[motion.at]\n{}",
                     joints, motion);
}

/// The gap between the ends, and E − Eᵀ for the rotation E from one to the other.
struct Gap {
  const Arm& arm;
  const Frame end;

  Numbers operator()(const Numbers& q) const {
    const Frame T = end_of(arm, q);
    double E[3][3] = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) E[i][j] = inner(T.R[i], end.R[j]);
    return {T.p[0] - end.p[0], T.p[1] - end.p[1], T.p[2] - end.p[2],
            E[2][1] - E[1][2], E[0][2] - E[2][0], E[1][0] - E[0][1]};
  }

  [[nodiscard]] bool is_posture(const Numbers& q) const {
    const Frame T = end_of(arm, q);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      most = std::fmax(most, std::fabs(T.p[i] - end.p[i]));
      for (std::size_t j = 0; j < 3; ++j)
        most = std::fmax(most, std::fabs(T.R[i][j] - end.R[i][j]));
    }
    return most < 1e-8;
  }
};

/// Returns values of the joints that follow none; angles are anywhere in their periods.
/// The same of an arm that turns about the z axis of the base alone.
struct LevelGap {
  const Gap gap;

  Numbers operator()(const Numbers& q) const {
    const Numbers all = gap(q);
    return {all[0], all[1], all[2], all[5]};
  }
  [[nodiscard]] bool is_posture(const Numbers& q) const { return gap.is_posture(q); }
};

inline Numbers random_values(RandomSource& random, const Arm& arm) {
  Numbers q;
  for (const Joint& joint : arm)
    if (!joint.leader)
      q.push_back(joint.slides || joint.turns == 0 ? random.between(-1, 1)
                                                   : joint.turns * random.between(-3.1, 3.1));
  return q;
}

inline Numbers periods_of(const Arm& arm) {
  Numbers periods;
  for (const Joint& joint : arm)
    if (!joint.leader) periods.push_back(joint.slides ? 0 : joint.turns * 2 * std::numbers::pi);
  return periods;
}

/// How many solutions are these values, up to the periods of the arm, which the test knows by itself.
inline int count_near(const Solutions& solutions, const Numbers& q, const Numbers& periods,
                      double distance) {
  int count = 0;
  for (const CertainSolution& s : solutions.found) {
    bool is_near = true;
    for (std::size_t i = 0; i < q.size(); ++i) {
      double gap = q[i] - mid(s.values[i]);
      if (periods[i] > 0) gap = std::remainder(gap, periods[i]);
      is_near = is_near && std::fabs(gap) <= distance;
    }
    count += is_near ? 1 : 0;
  }
  return count;
}

/// The planted posture is in the list once, each of the list is one, and no start leads to another one.
template <class Equations>
void expect_all(const Equations& gap, const Arm& arm, const Numbers& planted,
                const Solutions& solutions, RandomSource& random, int starts) {
  const Numbers periods = periods_of(arm);
  EXPECT_EQ(count_near(solutions, planted, periods, 1e-7), 1) << text_of(arm, planted);
  for (std::size_t i = 0; i < periods.size(); ++i)
    EXPECT_NEAR(solutions.unknowns[i].period, periods[i], 1e-9);
  for (const CertainSolution& s : solutions.found) {
    EXPECT_TRUE(gap.is_posture(middle_of(s.values))) << text_of(arm, planted);
    EXPECT_EQ(count_near(solutions, middle_of(s.values), periods, 1e-7), 1);
    EXPECT_NE(s.sign, 0);
  }
  for (int start = 0; start < starts; ++start) {
    const Numbers found = newton(gap, random_values(random, arm));
    bool is_in_range = !found.empty();
    for (std::size_t i = 0; i < found.size(); ++i)
      is_in_range = is_in_range && (periods[i] > 0 || std::fabs(found[i]) <= kRange);
    if (is_in_range && gap.is_posture(found)) {
      EXPECT_EQ(count_near(solutions, found, periods, 1e-6), 1) << text_of(arm, planted);
    }
  }
}

inline void expect_all(const Arm& arm, const Numbers& planted, const Solutions& solutions,
                       RandomSource& random, int starts) {
  expect_all(Gap{arm, end_of(arm, planted)}, arm, planted, solutions, random, starts);
}

inline Vec random_vector(RandomSource& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

inline Vec random_axis(RandomSource& random, const Vec& before) {
  static const Vec kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 3, 4}, {1, 2, 2}, {2, -1, 2}};
  return random.one_in(3) ? before : kAxes[random.below(6)];
}

/// The product of the pivots of the derivatives of the gap, in doubles.
inline double determinant(const Arm& arm, const Numbers& q) {
  const Gap gap{arm, end_of(arm, q)};
  std::vector<Numbers> columns;
  for (std::size_t k = 0; k < 6; ++k) {
    Numbers up = q, down = q;
    up[k] += 1e-6, down[k] -= 1e-6;
    columns.push_back(gap(up));
    const Numbers below = gap(down);
    for (std::size_t i = 0; i < 6; ++i) columns[k][i] = (columns[k][i] - below[i]) / 2e-6;
  }
  double product = 1;
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t j = k + 1; j < 6; ++j)
      if (std::fabs(columns[j][k]) > std::fabs(columns[k][k])) std::swap(columns[j], columns[k]);
    product *= columns[k][k];
    for (std::size_t j = k + 1; j < 6 && columns[k][k] != 0; ++j)
      for (std::size_t i = 6; i-- > k;)
        columns[j][i] -= columns[j][k] / columns[k][k] * columns[k][i];
  }
  return product;
}

/// Six joints that follow none, and `followers` behind, between and before them. Where the frames are not turned
/// and axes are alike, joints are parallel.
inline Arm any_arm(RandomSource& random, std::size_t followers) {
  static const double kMultipliers[] = {-1, -1, -1, 1, 2, 0.5, -0.5, 0, 3, -1.5};
  Arm arm;
  Vec axis{0, 0, 1};
  std::size_t leaders = 0;
  for (std::size_t left = 6 + followers; left > 0; --left) {
    Joint joint;
    joint.xyz = random_vector(random);
    if (random.one_in(3))
      for (double& part : joint.quaternion) part = random.between(-1, 1);
    joint.axis = axis = random_axis(random, axis);
    if (random.below(left) < 6 - leaders) {
      ++leaders;
    } else {
      joint.leader = random.below(6);
      joint.multiplier = kMultipliers[random.below(10)];
      joint.offset = random.one_in(2) ? 0 : random.between(-1, 1);
    }
    arm.push_back(joint);
  }
  std::vector<Joint*> leading;
  for (Joint& joint : arm)
    if (!joint.leader) leading.push_back(&joint);
  for (const Joint& joint : arm)
    if (joint.leader && std::fmod(joint.multiplier, 1) != 0) leading[*joint.leader]->turns = 2;
  return arm;
}

/// One whose end can move in every direction.
inline Arm random_arm(RandomSource& random, std::size_t followers) {
  for (;;) {
    const Arm arm = any_arm(random, followers);
    if (std::fabs(determinant(arm, random_values(random, arm))) > 1e-3) return arm;
  }
}

/// Shoulder, elbow and a wrist, of random lengths. With a parallelogram the orientation of the forearm does not
/// depend on q2.
inline Arm usual_arm(RandomSource& random, bool has_parallelogram) {
  const auto length = [&] { return random.between(0.1, 0.8); };
  Arm arm = {{.xyz = {0, 0, length()}},
             {.xyz = {length(), 0, 0}, .axis = {0, 1, 0}},
             {.xyz = {0, 0, length()}, .axis = {0, 1, 0}},
             {.xyz = {length(), 0, length() / 4}, .axis = {1, 0, 0}},
             {.xyz = {length(), 0, 0}, .axis = {0, 1, 0}},
             {.xyz = {length(), 0, 0}, .axis = {1, 0, 0}}};
  if (!has_parallelogram) return arm;
  arm.insert(arm.begin() + 2,
             {.xyz = arm[2].xyz, .axis = {0, 1, 0}, .leader = 1, .multiplier = -1});
  arm[3].xyz = {};
  return arm;
}

}  // namespace regulus::detail::test::coupled_arms
