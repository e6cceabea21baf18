// SPDX-License-Identifier: GPL-3.0-or-later
// The limits of an arm's joints are the frame of every question about it.
#include "codegen/model/mechanism/joint_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/model/request.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::joint_limits {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kArm =
    "regulus = 1\nname = \"arm\"\n[serial]\njoints = [{ name = \"q1\" }, { name = \"q2\", xyz = "
    "[1, "
    "0, 0], axis = [0, 1, 0] }]\n"
    "[motion.limits]\nq1 = [\"-90deg\", \"90deg\"]\nq2 = [0, 2]\n"
    "[motion.work]\nq1 = [0, 1]\nq2 = 1\n"
    "[motion.beyond]\nq1 = [0, 1.6]\nq2 = 1\n"
    "[motion.curve]\nparameters = { T = [0, 1] }\nq1 = 0\nq2 = \"3*T\"\n";

ModelOptions asked(const std::string& motion) {
  ModelOptions options;
  options.path = "arm.toml";
  options.motion = motion;
  options.text = kArm;
  return options;
}

std::string refusal_of(const ModelOptions& options) try {
  static_cast<void>(read_request(options));
  return "";
} catch (const InputError& error) {
  return error.what();
}

TEST(JointLimits, HoldMotionsRangesAndFormulas) {
  EXPECT_EQ(refusal_of(asked("limits")), "");
  EXPECT_EQ(refusal_of(asked("work")), "");
  EXPECT_THAT(refusal_of(asked("beyond")),
              HasSubstr("q1 takes [0, 1.6] rad, beyond its limits [-1.5708, 1.5708] rad"));
  EXPECT_THAT(refusal_of(asked("curve")), HasSubstr("q2 takes 2.0625 rad"));
  ModelOptions wider = asked("limits");
  wider.ranges = {"q2=0:2.5"};
  EXPECT_THAT(refusal_of(wider), HasSubstr("q2 takes [0, 2.5] rad, beyond its limits [0, 2] rad"));
  wider.ranges = {"q2=0:2"};
  EXPECT_EQ(refusal_of(wider), "");
}

TEST(JointLimits, AreLeftByAnOptionAndTheNotesSaySo) {
  ModelOptions options = asked("beyond");
  options.beyond_limits = true;
  std::vector<std::string> heard;
  options.warn = [&heard](const std::string& note) { heard.push_back(note); };
  const Request request = read_request(options);
  EXPECT_THAT(request.notes,
              ElementsAre(HasSubstr("the question leaves the limits of joints: q1")));
  EXPECT_EQ(heard, request.notes);
}

TEST(JointLimits, HoldWayPointsAndTheLineIsNamed) {
  const test::TemporaryDirectory folder;
  const std::string points = std::string(folder.path()) + "/points.csv";
  ModelOptions options = asked("limits");
  options.waypoints = points;
  std::ofstream(points) << "q1,q2\n0,1\n1,2\n1,0\n";
  EXPECT_EQ(refusal_of(options), "");
  std::ofstream(points) << "q1,q2\n0,1\n1,1\n1,2.5\n";
  EXPECT_THAT(refusal_of(options), HasSubstr("points.csv:4: q2 takes 2.5 rad"));
  std::ofstream(points) << "q1 [deg],q2\n0,1\n91,1\n";
  EXPECT_THAT(refusal_of(options), HasSubstr("points.csv:3: q1 takes 1.58825 rad"));
  options.beyond_limits = true;
  EXPECT_THAT(read_request(options).notes, ElementsAre(HasSubstr("q1 takes 1.58825 rad")));
}

TEST(WayPoints, BeyondATurnGetAWarningWithTheirLine) {
  const test::TemporaryDirectory folder;
  const std::string points = std::string(folder.path()) + "/points.csv";
  std::ofstream(points) << "q1,q2\n0,1\n90,1\n180,1\n";
  ModelOptions options = asked("work");
  options.waypoints = points;
  options.beyond_limits = true;
  EXPECT_THAT(read_request(options).notes,
              testing::Contains(HasSubstr("points.csv:3: q1 is 90 rad, more than a turn")));
}

TEST(JointLimits, AreOfArmsOnly) {
  ModelOptions options;
  options.path = "cart.toml";
  options.motion = "work";
  options.text =
      "regulus = 1\nname = \"cart\"\n[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x\"]]\n"
      "[motion.limits]\nx = [1, 2]\n[motion.work]\nx = [1, 3]\n";
  EXPECT_THAT(read_request(options).notes, IsEmpty());
}

}  // namespace
}  // namespace regulus::detail::joint_limits
