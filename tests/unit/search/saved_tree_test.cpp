// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/search/saved_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace regulus::detail::test {
namespace {

TEST(SavedTree, TilesTheVariety) {
  const std::vector<Interval> root{{0, 1}, {-1, 3}};
  const RestoredTree tree({"0:1 1:0 2- 3=0x1p+1 ", "4- ", {3}, {}}, root, 2);
  EXPECT_EQ(tree.size(), 5U);
  EXPECT_EQ(tree.open(), 1U);
  ASSERT_EQ(tree.leaves().size(), 3U);
  EXPECT_EQ(tree.leaves()[1].bound, 2);
  EXPECT_EQ(tree.box(0), root);
  EXPECT_EQ(tree.box(2), (std::vector<Interval>{{0, 1}, {1, 3}}));
  EXPECT_EQ(tree.box(3), (std::vector<Interval>{{0, 0.5}, {-1, 1}}));
  EXPECT_EQ(tree.box(4), (std::vector<Interval>{{0.5, 1}, {-1, 1}}));
  EXPECT_EQ(tree.depth(0), 0U);
  EXPECT_EQ(tree.depth(2), 1U);
  EXPECT_EQ(tree.depth(4), 2U);
}

TEST(SavedTree, IsReadAsItWasWritten) {
  const double least = std::numeric_limits<double>::denorm_min();
  SavedTree saved;
  saved.add_split(0, 1);
  saved.add_leaf(1, least);
  saved.add_split(2, 0);
  saved.add_leaf(4, std::numeric_limits<double>::infinity());
  saved.add_open(3, 1.0 / 3);
  const RestoredTree tree(saved, {{0, 1}, {0, 1}}, 2);
  ASSERT_EQ(tree.leaves().size(), 3U);
  EXPECT_EQ(tree.leaves()[0].bound, least);
  EXPECT_EQ(tree.leaves()[1].bound, std::numeric_limits<double>::infinity());
  EXPECT_EQ(tree.leaves()[2].bound, 1.0 / 3);
}

TEST(SavedTree, TilesTheVarietyByCuts) {
  SavedTree saved;
  saved.add_split(0, 1, -0.5);
  saved.add_split(2, 0, 0.125);
  for (const BoxId leaf : {1, 3, 4}) saved.add_leaf(leaf, 0);
  const std::vector<Interval> root{{0, 1}, {-1, 3}};
  const RestoredTree tree(saved, root, 2, Splits::kByCuts);
  EXPECT_EQ(tree.box(1), (std::vector<Interval>{{0, 1}, {-1, -0.5}}));
  EXPECT_EQ(tree.box(3), (std::vector<Interval>{{0, 0.125}, {-0.5, 3}}));
  EXPECT_EQ(tree.box(4), (std::vector<Interval>{{0.125, 1}, {-0.5, 3}}));
  EXPECT_EQ(tree.steps()[1].at, 0.125);
  EXPECT_THROW(RestoredTree(saved, root, 2), SavedTreeError) << "halves are asked for";
  EXPECT_THROW(RestoredTree({"0:1", "1- 2-", {}, {}}, root, 2, Splits::kByCuts), SavedTreeError);
  for (const char* outside : {"0:0@0x1p+0", "0:0@-0x1p+0", "0:0@0x0p+0"})
    EXPECT_THROW(static_cast<void>(
                     RestoredTree({outside, "1- 2-", {}, {}}, root, 2, Splits::kByCuts).box(1)),
                 SavedTreeError)
        << outside;
  for (const char* other : {"0:0@", "0:0@1", "0:0@0xnan", "0:0@0x1p-1x", "0:2@0x1p-1"})
    EXPECT_THROW(RestoredTree({other, "1- 2-", {}, {}}, root, 2, Splits::kByCuts), SavedTreeError)
        << other;
}

TEST(SavedTree, RefusesOtherTexts) {
  const auto make = [](const char* steps, const char* open, std::vector<BoxId> shown = {}) {
    return RestoredTree({steps, open, std::move(shown), {}},
                        {{0, 1}, {1, std::nextafter(1, 2)}, {0, 1}}, 2);
  };
  EXPECT_NO_THROW(make("0:0", "1- 2=0x1p+0"));
  for (const char* steps : {"", "0:2", "0:0 0:0", "3:0 0:0", "0:0 1=0x1p+0 1-", "0:0 1~", "0:0 1-x",
                            "0:-1", "x", ":", "-", "0:0 1=1.5", "0:0 1=0x-1p+0", "0:0 1=0xnan"})
    EXPECT_THROW(make(steps, "2-"), SavedTreeError) << steps;
  EXPECT_THROW(make("0:0", "1-"), SavedTreeError);
  EXPECT_THROW(make("0:0", "1- 2- 2-"), SavedTreeError);
  EXPECT_THROW(make("0:0", "1- 2~"), SavedTreeError);
  EXPECT_THROW(make("0:0", "1- 2-", {0, 3}), SavedTreeError);
  EXPECT_THROW(static_cast<void>(make("0:1", "1- 2-").box(1)), SavedTreeError);
}

}  // namespace
}  // namespace regulus::detail::test
