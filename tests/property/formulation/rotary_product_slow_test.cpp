// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/formulation/rotary_product.hpp"

namespace regulus::detail::rotary_product {
namespace {

TEST(ManyRotaryProducts, AreTheNumericProductOfRandomRobotsWithCranks) {
  Count count;
  compare_random("RUS", 12, 11, count);
  EXPECT_GE(count.points, 40);
  EXPECT_GE(count.boxes, 20);
  EXPECT_GE(count.steps, 100);
  EXPECT_GE(count.second_steps, 100);
  EXPECT_GE(count.turned, 6);
}

TEST(ManyRotaryProducts, AreTheNumericProductOfRandomRobotsOnRails) {
  Count count;
  compare_random("PUS", 12, 13, count);
  EXPECT_GE(count.points, 40);
  EXPECT_GE(count.steps, 100);
}

}  // namespace
}  // namespace regulus::detail::rotary_product
