// SPDX-License-Identifier: GPL-3.0-or-later
// Robots with loops that others have published: `regulus import` against the kinematics of their
// files. They are no part of the project: REGULUS_LOOP_ROBOTS names the folder that has them, each in
// a folder of its own with robot.urdf and robot.yaml.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <ostream>

#include "tests/property/import/links.hpp"
#include "tests/support/loops/urdf_text.hpp"

namespace regulus::detail::test {

struct LoopRobot {
  const char* name;
  const char* more_motors;  ///< besides those of its list; "" for none
  std::size_t idle;         ///< freedoms that neither loops nor motors determine
};

inline void PrintTo(const LoopRobot& robot, std::ostream* stream) { *stream << robot.name; }

constexpr LoopRobot kLoopRobots[] = {
    {"5bar_linkage", "", 1},  // a pin between two in line
    {"battobot_6d", "", 0},
    {"digit_like", "", 3},  // rods
    {"disney_like", "free_universal4", 2},
    {"robot_delta", "", 3},
    {"talos_like", "", 1},
};

inline std::string folder_of(const std::string& robot) {
  const char* folder = std::getenv("REGULUS_LOOP_ROBOTS");
  return folder == nullptr ? "" : std::string(folder) + "/" + robot;
}

inline ImportOptions options_for(const LoopRobot& robot, FileRobot& file) {
  ImportOptions options;
  if (*robot.more_motors != '\0') {
    file.motors.emplace_back(robot.more_motors);
    options.actuated = file.motors;
  }
  return options;
}

/// Newton's method finds a configuration of the model for so many random drives.
inline void expect_robot(const LoopRobot& robot, int drives) {
  FileRobot file = robot_in(folder_of(robot.name));
  const ImportOptions options = options_for(robot, file);
  const Imported imported = import_robot_file(folder_of(robot.name) + "/robot.urdf", options);
  const Model model = parse_model(imported.model, "model.toml");
  const ComparedClosure compared(file, model);
  Compared result;
  constexpr double kSnapped = 1e-6;  // more than what snapping changes
  compare(compared, model, robot.idle, 1, drives, kSnapped, result);
  EXPECT_EQ(result.ends, 0);
  EXPECT_EQ(result.drives, drives);
  if (testing::Test::HasFailure()) FAIL() << imported.report() << imported.model;
}

class LoopRobots : public testing::TestWithParam<LoopRobot> {
 protected:
  void SetUp() override {
    if (folder_of("").empty()) GTEST_SKIP() << "REGULUS_LOOP_ROBOTS names no folder with robots";
    if (!std::filesystem::exists(folder_of(GetParam().name)))
      GTEST_SKIP() << "there is no " << folder_of(GetParam().name);
  }
};

inline std::string name_of(const testing::TestParamInfo<LoopRobot>& info) {
  std::string name = info.param.name;
  return name[0] == '5' ? "five" + name.substr(1) : name;
}

}  // namespace regulus::detail::test
