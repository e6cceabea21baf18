// SPDX-License-Identifier: GPL-3.0-or-later
// Models made of SDF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "tests/support/robots/robot_file.hpp"
#include "tests/support/serial/model_twists.hpp"

namespace regulus::detail::test::sdf {
namespace {

using testing::HasSubstr;

Imported imported(const std::string& text, const ImportOptions& options = {}) {
  return import_robot(text, "arm.sdf", options);
}

/// The arm of arm.sdf, all of whose frames are relative to others, by its numbers.
std::vector<ChainJoint> chain_of_arm() {
  const double quarter = std::numbers::pi / 2;
  const auto z = [](double a) { return turn_about({0, 0, 1}, a); };
  const auto x = [](double a) { return turn_about({1, 0, 0}, a); };
  const Frame upper{z(quarter), {0, 0, 0.3}};            // of the model
  const Frame elbow{x(0.3), {0.4, 0, 0.3}};              // of the model
  const Frame fore = elbow * Frame{.p = {0, 0.1, 0}};    // of the model
  const Frame hand = fore * Frame{z(0.5), {0.3, 0, 0}};  // of the model
  const auto inverse = [](const Frame& f) {
    Mat R{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) R[i][j] = f.R[j][i];
    return Frame{R, -1.0 * (R * f.p)};
  };
  const Mat back = inverse({elbow.R, {}}).R;
  return {{.origin = upper, .axis = {0, 0, 1}},
          {.origin = inverse(upper) * elbow, .axis = back * Vec{0, 1, 0}},
          {.origin = inverse(elbow) * hand, .axis = {1, 1, 0}, .slides = true},
          {.origin = Frame{.p = {0, 0, 0.1}}, .axis = {1, 0, 0}}};
}

TEST(Sdf, HasTheTwistsOfItsFrames) {
  const Model model = parse_model(imported(robot_text("arm.sdf")).model, "imported.toml");
  ASSERT_EQ(model.pose.size(), 4U);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> between(-3, 3);
  for (int pose = 0; pose < 100; ++pose) {
    std::vector<double> q(4);
    for (double& x : q) x = between(random);
    expect_same_arm(model_twists(model, q), difference_twists(chain_of_arm(), q));
  }
}

/// Joint j follows joint i.
std::string followed(const std::string& type, const std::string& mimic) {
  const auto joint = [](const std::string& name, const std::string& kind, const char* parent,
                        const char* child, const std::string& more) {
    return "<joint name='" + name + "' type='" + kind + "'><parent>" + parent + "</parent><child>" +
           child + "</child><axis><xyz>0 1 0</xyz>" + more + "</axis></joint>";
  };
  return "<sdf version='1.11'><model name='m'><link name='a'/><link name='b'><pose>1 0 0 0 0 "
         "0</pose></link><link name='c'><pose>2 0 0 0 0 0</pose></link>" +
         joint("j", "revolute", "b", "c", mimic) + joint("i", type, "a", "b", "") +
         "</model></sdf>";
}

TEST(Sdf, ReadsJointsThatFollowOthers) {
  EXPECT_THAT(imported(followed("revolute", "<mimic joint='i'/>")).model,
              HasSubstr("{ mimic = \"i\", "));
  EXPECT_THAT(
      imported(
          followed("revolute",
                   "<mimic joint='i'><multiplier> -2 </multiplier><offset>0.1</offset></mimic>"))
          .model,
      HasSubstr("{ mimic = \"i\", multiplier = -2, offset = 0.1, "));
  // 1/2·(q − 0.6) + 0.1.
  const std::string rule =
      "<mimic joint='i' axis='axis'><multiplier>0.5</multiplier><offset>0.1</offset>"
      "<reference>0.6</reference></mimic>";
  EXPECT_THAT(imported(followed("prismatic", rule)).model,
              HasSubstr("multiplier = 0.5, offset = -0.2, "));
  EXPECT_THAT(imported(followed("revolute",
                                "<mimic joint='i'><multiplier>2</multiplier><reference>"
                                "1.5707963267948966</reference></mimic>"))
                  .model,
              HasSubstr("multiplier = 2, offset = \"-pi\", "));
  for (const char* bad :
       {"<mimic/>", "<mimic joint='i' axis='axis2'/>", "<mimic joint='k'/>", "<mimic joint='j'/>",
        "<mimic joint='i'><multiplier>two</multiplier></mimic>"})
    EXPECT_THROW(static_cast<void>(imported(followed("revolute", bad))), std::runtime_error) << bad;
}

TEST(Sdf, HasItsRanges) {
  const std::string model = imported(robot_text("arm.sdf")).model;
  EXPECT_THAT(model, HasSubstr("pan = [\"-pi\", \"pi\"] # turns without end"));
  EXPECT_THAT(model, HasSubstr("elbow = [-1.5, 1.5]"));
  EXPECT_THAT(model, HasSubstr("reach = [0, 0.2]"));
}

TEST(Sdf, MayHaveTheRootOfItsFirstVersions) {
  const std::string text =
      "<gazebo version='1.2'><model name='m'><link name='a'/><link name='b'><pose>0 0 1 0 0 "
      "0</pose></link><joint name='j' type='revolute'><parent>a</parent><child>b</child><axis>"
      "<limit><lower>-1</lower><upper>1</upper></limit><xyz>0 0 1</xyz></axis></joint></model>"
      "</gazebo>";
  EXPECT_THAT(imported(text).model, HasSubstr("j = [-1, 1]"));
}

}  // namespace
}  // namespace regulus::detail::test::sdf
