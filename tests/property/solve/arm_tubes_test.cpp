// SPDX-License-Identifier: GPL-3.0-or-later
// The tubes of postures while lengths and angles are within tolerances. The oracle is Newton's method in doubles, on
// arms with other numbers.
#include <algorithm>

#include "tests/property/solve/coupled_arms.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

/// Modified Denavit-Hartenberg rows: a, alpha, d.
using Rows = std::array<std::array<double, 3>, 6>;
constexpr Rows kPuma = {{{0, 0, 0},
                         {0, -kQuarter, 0.2435},
                         {0.4318, 0, -0.0934},
                         {-0.0203, kQuarter, 0.4331},
                         {0, -kQuarter, 0},
                         {0, kQuarter, 0}}};

Frame end_of(const Rows& rows, const Numbers& q) {
  Frame frame;
  for (std::size_t i = 0; i < 6; ++i)
    frame = frame * Frame{turn_about({1, 0, 0}, rows[i][1]), {rows[i][0], 0, 0}} *
            Frame{turn_about({0, 0, 1}, q[i]), {0, 0, rows[i][2]}};
  return frame;
}

std::string text_of(const Rows& rows, const Numbers& q, const std::string& tolerances) {
  std::string joints, motion;
  for (std::size_t i = 0; i < 6; ++i) {
    joints += fmt::format("{{ name = \"q{}\", a = {:.17g}, alpha = {:.17g}, d = {:.17g} }},\n",
                          i + 1, rows[i][0], rows[i][1], rows[i][2]);
    motion += fmt::format("q{} = {:.17g}\n", i + 1, q[i]);
  }
  return fmt::format(
      "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"modified-dh\"\n{}joints = [\n{}]\n"
      "[motion.at]\n{}",
      tolerances, joints, motion);
}

struct RowsGap {
  const Rows rows;
  const Frame end;

  Numbers operator()(const Numbers& q) const {
    const Frame T = end_of(rows, q);
    double E[3][3] = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) E[i][j] = inner(T.R[i], end.R[j]);
    return {T.p[0] - end.p[0], T.p[1] - end.p[1], T.p[2] - end.p[2],
            E[2][1] - E[1][2], E[0][2] - E[2][0], E[1][0] - E[0][1]};
  }
};

/// A corner of the tolerances, or a place within them.
double deviation(RandomSource& random, double most) {
  return random.one_in(2) ? random.between(-most, most) : (random.one_in(2) ? most : -most);
}

int tubes_with(const Solutions& solutions, const Numbers& q) {
  return int(std::ranges::count_if(solutions.found, [&](const CertainSolution& s) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double turns = std::round((mid(s.values[i]) - q[i]) / (2 * std::numbers::pi));
      const double x = q[i] + turns * 2 * std::numbers::pi;
      if (!(s.values[i].lo - 1e-12 <= x && x <= s.values[i].hi + 1e-12)) return false;
    }
    return true;
  }));
}

struct Sizes {
  double length, angle;
};

/// Each posture of the nominal arm leads to one in a tube of its own, whatever the numbers are.
void expect_tubes(const Solutions& tubes, const Solutions& points, const Numbers& q,
                  const Sizes& sizes, RandomSource& random) {
  ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
  ASSERT_EQ(tubes.found.size(), points.found.size());
  const Frame end = end_of(kPuma, q);
  for (int other = 0; other < 30; ++other) {
    Rows rows = kPuma;
    for (auto& row : rows) {
      row[0] += deviation(random, sizes.length);
      row[1] += deviation(random, sizes.angle);
      row[2] += deviation(random, sizes.length);
    }
    for (const CertainSolution& point : points.found) {
      const Numbers posture = newton(RowsGap{rows, end}, middle_of(point.values));
      ASSERT_FALSE(posture.empty());
      EXPECT_EQ(tubes_with(tubes, posture), 1);
    }
  }
}

/// The PUMA 560 with each of its lengths, those that are 0 too, within 1 mm, and then with its angles.
TEST(PosturesOfAnArmWithEveryLengthUncertain, AreInTheirTubes) {
  RandomSource random(71);
  for (int round = 0; round < trials(1, 12); ++round) {
    const Numbers q = {random.between(-3, 3), random.between(-1, 1),    random.between(-1, 1),
                       random.between(-3, 3), random.between(0.7, 1.5), random.between(-3, 3)};
    const Solutions points = solved(text_of(kPuma, q, ""));
    ASSERT_TRUE(is_complete(points));
    if (std::ranges::any_of(points.found, [](const auto& s) { return s.condition > 14; })) continue;
    const Solutions lengths = solved(text_of(kPuma, q, "length_tolerance = 0.0005\n"));
    expect_tubes(lengths, points, q, {0.0005, 0}, random);
    const Solutions all =
        solved(text_of(kPuma, q, "length_tolerance = 1e-4\nangle_tolerance = 1e-4\n"));
    expect_tubes(all, points, q, {1e-4, 1e-4}, random);
  }
}

/// Which was shown of four postures only while each row took a length for another one.
TEST(PosturesOfThePumaWithinAMillimetre, AreEight) {
  RandomSource random(72);
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const Solutions points = solved(text_of(kPuma, q, "")),
                  tubes = solved(text_of(kPuma, q, "length_tolerance = 0.001\n"));
  ASSERT_EQ(points.found.size(), 8U);
  expect_tubes(tubes, points, q, {0.001, 0}, random);
  for (const CertainSolution& s : tubes.found) {
    EXPECT_NE(s.sign, 0);
    for (const Interval& value : s.values) EXPECT_LT(width_ru(value), 0.065);
  }
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
