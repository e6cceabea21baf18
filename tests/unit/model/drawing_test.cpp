// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "codegen/model/file/model_file.hpp"

namespace regulus::detail::test::drawing {
namespace {

using detail::Point;
using Kind = Drawing::Kind;

/// The values of a point at a pose, with the nominal geometry.
std::array<double, 3> at(const Model& model, const Point& point, const std::vector<double>& pose) {
  GiNaC::exmap values;
  for (std::size_t i = 0; i < model.pose.size(); ++i) values[model.pose[i].symbol] = pose[i];
  for (const GeometryParameter& g : model.geometry) values[g.symbol] = g.value;
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = GiNaC::ex_to<GiNaC::numeric>(point[i].subs(values).evalf()).to_double();
  return result;
}

void expect_near(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(p[i], q[i], 1e-12);
}

std::vector<Drawing::Part> parts_of(const Model& model, Kind kind) {
  std::vector<Drawing::Part> parts;
  for (const Drawing::Part& part : model.drawing->parts)
    if (part.kind == kind) parts.push_back(part);
  return parts;
}

TEST(ADrawing, OfAHexapodHasItsAnchors) {
  const Model model = load_model(std::string(REGULUS_SOURCE_DIR) + "/models/robot_1.toml");
  const auto legs = parts_of(model, Kind::kLeg);
  ASSERT_EQ(legs.size(), 6u);
  EXPECT_EQ(legs[2].row, 2);
  // phi = 90 degrees turns B3 = (7, -1, 0) to (1, 7, 0).
  const std::vector<double> pose = {1, 2, 45, 0, 0, std::numbers::pi / 2};
  expect_near(at(model, legs[2].points[0], pose), {12, -3, 0});
  expect_near(at(model, legs[2].points[1], pose), {2, 9, 45});
}

TEST(ADrawing, OfAnArmEndsAtItsTool) {
  const Model model = parse_model(
      "regulus = 1\nname = \"arm\"\n[serial]\njoints = [\n  { name = \"a\", xyz = [0, 0, 1] },\n"
      "  { name = \"b\", type = \"prismatic\", xyz = [2, 0, 0], axis = [1, 0, 0] },\n]\n"
      "tool = { xyz = [0, 3, 0] }\n[motion.zero]\na = 0\nb = 0\n",
      "arm.toml");
  const auto links = parts_of(model, Kind::kLink);
  const std::vector<double> pose = {std::numbers::pi / 2, 5};
  expect_near(at(model, links.front().points[1], pose), {0, 0, 1});
  // Along x by 2 + 5 and along y by 3, turned by 90 degrees.
  expect_near(at(model, links.back().points[1], pose), {-3, 7, 1});
  ASSERT_EQ(parts_of(model, Kind::kJoint).size(), 2u);
  expect_near(at(model, parts_of(model, Kind::kJoint)[1].points[1], pose), {0, 3, 1});
}

TEST(ADrawing, OfLegsHasCranksAndRodsOfTheirLengths) {
  const Model model = parse_model(
      "regulus = 1\nname = \"legs\"\n[legs]\ncrank = 1\nrod = 2\nmode = \"+\"\n"
      "[[legs.leg]]\ntype = \"RRR\"\nbase = [0, 0]\nplatform = [0, 0]\n"
      "[[legs.leg]]\ntype = \"RRR\"\nbase = [3, 0]\nplatform = [1, 0]\n"
      "[[legs.leg]]\ntype = \"RPR\"\nbase = [0, 3]\nplatform = [0, 1]\n"
      "[motion.zero]\nx = 1\ny = 1\nphi = 0\n",
      "legs.toml");
  const std::vector<double> pose = {1.2, 1.1, 0.2};
  const auto distance = [&](const Drawing::Part& part) {
    const auto p = at(model, part.points[0], pose), q = at(model, part.points[1], pose);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  };
  const auto links = parts_of(model, Kind::kLink);
  ASSERT_EQ(links.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(distance(links[i]), i % 2 == 0 ? 1 : 2, 1e-12);
    EXPECT_EQ(links[i].row, i % 2 == 0 ? -1 : static_cast<int>(i / 2));
  }
  EXPECT_EQ(parts_of(model, Kind::kLeg).front().row, 2);
}

TEST(ADrawing, OfATableHasItsPointsAndRows) {
  const Model model = load_model(std::string(REGULUS_SOURCE_DIR) + "/models/orthoglide.toml");
  const auto legs = parts_of(model, Kind::kLeg);
  ASSERT_EQ(legs.size(), 3u);
  const std::vector<double> pose = {0.1, 0.2, -0.3};
  const auto motor = at(model, legs[0].points[0], pose), end = at(model, legs[0].points[1], pose);
  EXPECT_NEAR(std::hypot(motor[0] - end[0], motor[1] - end[1], motor[2] - end[2]), 1, 1e-12);
  EXPECT_EQ(parts_of(model, Kind::kLink).front().row, -1);
}

}  // namespace
}  // namespace regulus::detail::test::drawing
