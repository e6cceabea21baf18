// SPDX-License-Identifier: GPL-3.0-or-later
// Platforms on six legs, in files with loops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/robots/robot_file.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

ImportOptions cuts() {
  ImportOptions options;
  for (const char* leg : {"2", "3", "4", "5", "6"})
    options.cuts.push_back(std::string("end_") + leg + "=socket_" + leg);
  return options;
}

/// The anchors of models/robot_1.toml, in metres.
void expect_robot_1(const Model& model) {
  const Model robot_1 = load_model(REGULUS_SOURCE_DIR "/models/robot_1.toml");
  ASSERT_EQ(model.geometry.size(), robot_1.geometry.size());
  for (std::size_t i = 0; i < model.geometry.size(); ++i) {
    EXPECT_EQ(model.geometry[i].name, robot_1.geometry[i].name);
    EXPECT_TRUE((model.geometry[i].value * 100 - robot_1.geometry[i].value).is_zero())
        << model.geometry[i].name;
  }
  ASSERT_EQ(model.motions.size(), 2U);
  EXPECT_TRUE(model.motions[0].pose[2].is_equal(GiNaC::numeric(45, 100)));
}

Model model_of(const std::string& file, const ImportOptions& options = {}) {
  return parse_model(import_robot(robot_text(file), file, options).model, "imported.toml");
}

TEST(Hexapod, IsFoundInMjcf) { expect_robot_1(model_of("hexapod.mjcf")); }
TEST(Hexapod, IsFoundInSdf) { expect_robot_1(model_of("hexapod.sdf")); }
TEST(Hexapod, IsFoundInUrdfWithCuts) { expect_robot_1(model_of("hexapod.urdf", cuts())); }

TEST(Hexapod, SaysWhatItsClaimLeavesOut) {
  EXPECT_THAT(import_robot(robot_text("hexapod.mjcf"), "h", {}).report(),
              HasSubstr("the joints at their ends may have singular poses of their own"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text, const ImportOptions& options = {}) {
  try {
    (void)import_robot(text, "h", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Hexapod, IsRefusedWithALegOfAnotherKind) {
  const std::string text = robot_text("hexapod.mjcf");
  EXPECT_THAT(refusal(replaced(text, "<joint name=\"pitch_3\" axis=\"0 1 0\"/>", "")),
              HasSubstr("leg 3 of the platform does not turn about one point at each end"));
  EXPECT_THAT(
      refusal(replaced(text, "<joint name=\"pitch_3\"", "<joint name=\"pitch_3\" pos=\"0 0 0.1\"")),
      HasSubstr("leg 3 of the platform does not turn about one point at each end"));
  EXPECT_THAT(refusal(replaced(text, "<joint name=\"slider_2\" type=\"slide\"",
                               "<joint name=\"slider_2\"")),
              HasSubstr("leg 2 of the platform has not one joint that slides"));
  EXPECT_THAT(refusal(replaced(text, "body2=\"upper_5\" anchor=\"-0.04",
                               "body2=\"upper_5\" anchor=\"0.04")),
              HasSubstr("leg 5 of the platform does not slide along the line between its ends"));
}

TEST(Hexapod, ThatIsOpenWhereItWasCutIsAClosure) {
  ImportOptions options = cuts();
  for (int leg = 1; leg <= 6; ++leg) options.actuated.push_back("slider_" + std::to_string(leg));
  const Imported robot = import_robot(
      replaced(robot_text("hexapod.urdf"), "<child link=\"socket_4\"/><origin xyz=\"0.04",
               "<child link=\"socket_4\"/><origin xyz=\"0.05"),
      "h", options);
  EXPECT_TRUE(parse_model(robot.model, "imported.toml").closure);
  EXPECT_THAT(robot.report(), HasSubstr("the loops are open by 0.01"));
}

TEST(Hexapod, IsRefusedIfAJointOfALegFollows) {
  EXPECT_THAT(refusal(replaced(robot_text("hexapod.mjcf"), "<equality>",
                               "<equality><joint joint1=\"slider_2\" joint2=\"slider_1\"/>")),
              HasSubstr("joint 'slider_2' of a leg follows joint 'slider_1'"));
}

TEST(Hexapod, LeavesOtherLoopsToAMessage) {
  std::string text = robot_text("hexapod.mjcf");
  for (const char* leg : {"5", "6"}) {
    const std::size_t at =
        text.find(std::string("    <connect body1=\"plate\" body2=\"upper_") + leg);
    text.erase(at, text.find('\n', at) - at + 1);
  }
  EXPECT_NE(refusal(text, {.base = "world", .tip = "upper_1"}), "");
}

}  // namespace
}  // namespace regulus::detail::test
