// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/robot_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <vector>

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;

/// A point on two cables from (0, 0) and (4, 0).
constexpr const char* kCart = R"(
regulus = 1
name = "cart <1>"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["x", "y"], ["x - 4", "y"]]
[drawing]
points = { A = [0, 0], B = [4, 0], P = ["x", "y"] }
legs = [["A", "P"], ["B", "P"]]
[motion.box]
x = [0, 2]
y = [1, 3]
)";

std::string picture_of(const std::string& text) {
  ModelOptions options;
  options.path = "cart.toml";
  return robot_picture(read_request(text, options));
}

struct Dot {
  double x, y;
};

/// The ends of each line, in pairs.
std::vector<Dot> dots_of(const std::string& svg) {
  std::vector<Dot> dots;
  const std::regex lines("polyline points=\"([\\d.]+),([\\d.]+) ([\\d.]+),([\\d.]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), lines), end; at != end; ++at) {
    dots.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
    dots.push_back({std::stod((*at)[3]), std::stod((*at)[4])});
  }
  return dots;
}

double distance(const Dot& a, const Dot& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(ThePictureOfARobot, HasItsShapeAtTheMiddleOfTheMotion) {
  const std::string svg = picture_of(kCart);
  const std::vector<Dot> dots = dots_of(svg);
  ASSERT_EQ(dots.size(), 4U);
  const double scale = distance(dots[0], dots[2]) / 4;
  EXPECT_NEAR(distance(dots[0], dots[1]) / scale, std::sqrt(5), 0.01);
  EXPECT_NEAR(distance(dots[2], dots[3]) / scale, std::sqrt(13), 0.01);
  EXPECT_LT(dots[1].y, dots[0].y) << "up is up";
  EXPECT_THAT(svg, HasSubstr("aria-label=\"cart &lt;1&gt;\""));
  EXPECT_LT(svg.size(), 2000U);
}

TEST(ThePictureOfARobot, IsEmptyWithoutPoints) {
  std::string text = kCart;
  text.erase(text.find("[drawing]"), text.find("[motion") - text.find("[drawing]"));
  EXPECT_EQ(picture_of(text), "");
}

}  // namespace
}  // namespace regulus::detail::test
