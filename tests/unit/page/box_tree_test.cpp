// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/page/box_tree.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace regulus::test {
namespace {

const std::vector<Interval> kRoot = {{0.0, 4.0}, {0.0, 1.0}, {2.0, 2.0}};

ClaimedBox box(Interval x, Interval y, const char* claim) { return {{x, y, {2.0, 2.0}}, claim}; }

TEST(ATreeOfBoxes, SplitsUntilEachBoxIsALeaf) {
  EXPECT_EQ(tree_of_boxes(kRoot, {box({1.0, 4.0}, {0.5, 1.0}, "free"),
                                  box({0.0, 1.0}, {0.0, 1.0}, "singular"),
                                  box({1.0, 4.0}, {0.0, 0.5}, "undecided")}),
            "s 0 0 1\nl 1 singular\ns 2 1 0.5\nl 3 undecided\nl 4 free\nend 3\n");
  EXPECT_EQ(tree_of_boxes(kRoot, {box({0.0, 4.0}, {0.0, 1.0}, "free")}), "l 0 free\nend 1\n");
}

TEST(ATreeOfBoxes, IsRefusedUnlessTheBoxesTileTheWhole) {
  const auto lower = box({0.0, 2.0}, {0.0, 1.0}, "free");
  EXPECT_THROW(static_cast<void>(tree_of_boxes(kRoot, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(tree_of_boxes(kRoot, {lower})), std::invalid_argument);
  for (const double begin : {1.9, 2.1})
    EXPECT_THROW(
        static_cast<void>(tree_of_boxes(kRoot, {lower, box({begin, 4.0}, {0.0, 1.0}, "free")})),
        std::invalid_argument)
        << begin;
  EXPECT_THROW(
      static_cast<void>(tree_of_boxes(kRoot, {lower, lower, box({2.0, 4.0}, {0.0, 1.0}, "free")})),
      std::invalid_argument);
}

TEST(ATreeOfBoxes, IsRefusedIfNoSplitsMakeIt) {
  // Four boxes around a fifth one, as bricks around a well.
  const auto at = [](double a, double b, double c, double d) {
    return box({a, b}, {c, d}, "free");
  };
  EXPECT_THROW(static_cast<void>(
                   tree_of_boxes(kRoot, {at(0, 3, 0, 0.25), at(3, 4, 0, 0.75), at(1, 4, 0.75, 1),
                                         at(0, 1, 0.25, 1), at(1, 3, 0.25, 0.75)})),
               std::invalid_argument);
}

}  // namespace
}  // namespace regulus::test
