// SPDX-License-Identifier: GPL-3.0-or-later
// The PUMA 560 by its rows, with an oracle in doubles.
#pragma once

#include <algorithm>

#include "tests/property/solve/coupled_arms.hpp"

namespace regulus::detail::test::coupled_arms {

inline constexpr double kQuarter = std::numbers::pi / 2;

/// Modified Denavit-Hartenberg rows: a, alpha, d.
using Rows = std::array<std::array<double, 3>, 6>;
inline constexpr Rows kPuma = {{{0, 0, 0},
                                {0, -kQuarter, 0.2435},
                                {0.4318, 0, -0.0934},
                                {-0.0203, kQuarter, 0.4331},
                                {0, -kQuarter, 0},
                                {0, kQuarter, 0}}};

inline Frame end_of(const Rows& rows, const Numbers& q) {
  Frame frame;
  for (std::size_t i = 0; i < 6; ++i)
    frame = frame * Frame{turn_about({1, 0, 0}, rows[i][1]), {rows[i][0], 0, 0}} *
            Frame{turn_about({0, 0, 1}, q[i]), {0, 0, rows[i][2]}};
  return frame;
}

/// `place`: lines of its motion, in the place of values of the joints.
inline std::string text_of(const Rows& rows, const Numbers& q, const std::string& tolerances,
                           const std::string& place = "") {
  std::string joints, motion;
  for (std::size_t i = 0; i < 6; ++i) {
    joints += fmt::format("{{ name = \"q{}\", a = {:.17g}, alpha = {:.17g}, d = {:.17g} }},\n",
                          i + 1, rows[i][0], rows[i][1], rows[i][2]);
    if (place.empty()) motion += fmt::format("q{} = {:.17g}\n", i + 1, q[i]);
  }
  return fmt::format(
      "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"modified-dh\"\n{}joints = [\n{}]\n"
      "[motion.at]\n{}",
      tolerances, joints, place.empty() ? motion : place);
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
inline double deviation(RandomSource& random, double most) {
  return random.one_in(2) ? random.between(-most, most) : (random.one_in(2) ? most : -most);
}

inline int tubes_with(const Solutions& solutions, const Numbers& q) {
  return int(std::ranges::count_if(solutions.found, [&](const CertainSolution& s) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double turns = std::round((mid(s.values[i]) - q[i]) / (2 * std::numbers::pi));
      const double x = q[i] + turns * 2 * std::numbers::pi;
      if (!(s.values[i].lo - 1e-12 <= x && x <= s.values[i].hi + 1e-12)) return false;
    }
    return true;
  }));
}

}  // namespace regulus::detail::test::coupled_arms
