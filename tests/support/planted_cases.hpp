// SPDX-License-Identifier: GPL-3.0-or-later
// Judges the test of a tube by systems whose roots are known.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/planted_system.hpp"

namespace regulus::detail::test {

/// Ensures   at sampled places each tube of which the test says so has exactly one root, and the test
///           says so of some and not of others.
inline void expect_no_false_one(std::uint64_t seed, std::size_t cases) {
  RandomSource random(seed);
  std::size_t ones = 0, others = 0, roots = 0;
  for (std::size_t number = 0; number < cases; ++number) {
    const PlantedSystem system(random, 1 + random.below(3), random.below(4));
    std::vector<Interval> box;
    const BranchTube tube = system.random_tube(random, box);
    std::vector<Interval> around, at, center;
    for (std::size_t k = 0; k < box.size(); ++k) {
      at.emplace_back(tube.at[k]);
      around.push_back(hull(box[k], at[k]));
    }
    for (const double c : tube.center) center.emplace_back(c);
    const auto here = system.over(at, center), there = system.over(around, enclose(tube, around));
    std::vector<double> middle;
    for (const Interval entry : here.by_unknown) middle.push_back(mid(entry));
    const auto inverse = approx_inverse_of(middle, system.unknowns());
    if (!inverse) continue;
    const TubeImage image =
        image_of(tube, box, *inverse, {here.value, there.by_unknown, there.by_variable});
    const bool is_one = has_one_solution(tube, image);
    ++(is_one ? ones : others);
    ASSERT_TRUE(!is_one || system.is_regular()) << "case " << number;
    for (int sample = 0; sample < 4; ++sample) {
      std::vector<double> x;
      for (const Interval range : box) x.push_back(point_of(random, range));
      const auto count = system.count_roots(tube, x);
      if (!count) continue;
      roots += !is_one && *count == 1;
      ASSERT_TRUE(!is_one || *count == 1) << "case " << number << ": " << *count << " roots";
    }
  }
  EXPECT_GT(ones, cases / 10);
  EXPECT_GT(others, cases / 10);
  EXPECT_GT(roots, cases / 50);
}

}  // namespace regulus::detail::test
