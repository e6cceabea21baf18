// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/search/frontier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

using Box = std::vector<Interval>;

TEST(Frontier, TakesTheLastFirst) {
  Frontier frontier(1);
  const Box a{{0, 4}}, b{{0, 2}};
  ASSERT_TRUE(frontier.push_top({7, 1, a}, 4));
  ASSERT_TRUE(frontier.push_top({8, 2, b}, 2));
  EXPECT_EQ(frontier.top().id, 8U);
  EXPECT_EQ(frontier.top().depth, 2U);
  EXPECT_EQ(frontier.top().box[0], b[0]);
  EXPECT_EQ(frontier.end().id, 7U);
  frontier.pop();
  EXPECT_EQ(frontier.top().id, 7U);
  EXPECT_EQ(frontier.max_size(), 2U);
}

TEST(Frontier, PutsTheSecondHalfJustBelowTheFirst) {
  Frontier frontier(1);
  const Box box{{0, 1}};
  ASSERT_TRUE(frontier.push_top({1, 0, box}, 8));
  ASSERT_TRUE(frontier.push_halves({2, 0, box}, 1, {3, 0, box}, 1));
  EXPECT_EQ(frontier.top().id, 2U);
  EXPECT_EQ(frontier.end().id, 1U);
  frontier.pop();
  EXPECT_EQ(frontier.top().id, 3U);
}

TEST(Frontier, PutsAWiderSecondHalfAtTheFarEnd) {
  Frontier frontier(1);
  const Box box{{0, 1}};
  ASSERT_TRUE(frontier.push_top({1, 0, box}, 2));
  ASSERT_TRUE(frontier.push_halves({2, 0, box}, 1, {3, 0, box}, 3));
  EXPECT_EQ(frontier.end().id, 3U);
  EXPECT_EQ(frontier.top().id, 2U);
  frontier.pop();
  EXPECT_EQ(frontier.top().id, 1U);
  frontier.pop_end();
  EXPECT_EQ(frontier.end().id, 1U);
  frontier.pop_end();
  EXPECT_TRUE(frontier.empty());
}

TEST(Frontier, KeepsEveryBoxWhenItGrows) {
  Frontier frontier(2);
  const std::size_t count = 5000;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = static_cast<double>(k);
    const Box box{{x, x + 1}, {-x, x}};
    ASSERT_TRUE(k % 3 == 0 ? frontier.push_end({k, 0, box}, 1) : frontier.push_top({k, 0, box}, 1));
  }
  std::vector<bool> seen(count);
  while (!frontier.empty()) {
    const OpenBox box = frontier.size() % 2 == 0 ? frontier.top() : frontier.end();
    EXPECT_FALSE(seen[box.id]);
    seen[box.id] = true;
    EXPECT_EQ(box.box[0].lo, static_cast<double>(box.id));
    EXPECT_EQ(box.box[1].hi, static_cast<double>(box.id));
    frontier.size() % 2 == 0 ? frontier.pop() : frontier.pop_end();
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<long>(count));
}

/// Splits every box of m ranges of width 1 down to width 2^-depth, `at_once` boxes at a time, and
/// checks the guarantee of Algorithm 1 about the list.
std::size_t largest_list(std::size_t m, int depth, std::size_t at_once, std::uint64_t seed) {
  Frontier frontier(m);
  test::RandomSource random(seed);
  EXPECT_TRUE(frontier.push_top({0, 0, Box(m, Interval(0, 1))}, 1.0));
  const double epsilon = std::ldexp(1.0, -depth);
  const auto width = [](const Box& box) {
    double widest = 0;
    for (const Interval& x : box) widest = std::max(widest, x.hi - x.lo);
    return widest;
  };
  for (int steps = 0; steps < 20000 && !frontier.empty(); ++steps) {
    std::vector<Box> taken;
    while (taken.size() < at_once && !frontier.empty()) {
      taken.emplace_back(frontier.top().box.begin(), frontier.top().box.end());
      frontier.pop();
    }
    for (std::size_t k = taken.size(); k-- > 0;) {
      Box first = taken[k];
      const double w = width(first);
      if (w <= epsilon || random.one_in(5)) continue;
      std::size_t widest = 0;
      while (first[widest].hi - first[widest].lo < w) ++widest;
      Box second = first;
      const Halves halves = *bisect(first[widest]);
      first[widest] = halves.left;
      second[widest] = halves.right;
      EXPECT_TRUE(frontier.push_halves({1, 0, first}, width(first), {2, 0, second}, width(second)));
    }
  }
  return frontier.max_size();
}

TEST(Frontier, StaysWithinTheStorageBoundOfThePaper) {
  for (const std::size_t m : {1U, 2U, 6U})
    for (const int depth : {3, 10, 20})
      for (std::uint64_t seed = 0; seed < 4; ++seed)
        EXPECT_LE(largest_list(m, depth, 1, seed), m * static_cast<std::size_t>(depth) + 1);
}

TEST(Frontier, StaysWithinTheBoundTimesTheBatch) {
  for (const std::size_t m : {1U, 3U, 6U})
    for (std::uint64_t seed = 0; seed < 4; ++seed)
      EXPECT_LE(largest_list(m, 10, 8, seed), 8 * (m * 10 + 1));
}

}  // namespace
}  // namespace regulus::detail
