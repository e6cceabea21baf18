// SPDX-License-Identifier: GPL-3.0-or-later
// Random hexapods with uncertain anchors, at single poses and in small boxes around them.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/use/api/regulus.hpp"
#include "tests/support/random_hexapod.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

class SinglePose : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Finding ask(const std::string& model, const char* motion) const {
    const std::string path = folder_.path() / "hexapod.toml";
    std::ofstream(path) << model;
    SearchOptions options;
    options.engine = Engine::kInterpreted;
    options.max_boxes = 500;
    return check(Question::of_file(path, motion), options);
  }

  TemporaryDirectory folder_;
};

TEST_P(SinglePose, IsNeverDecidedWorseThanABoxAroundIt) {
  RandomSource random(16);
  for (int trial = 0; trial < trials(4, 12); ++trial) {
    const RandomHexapod robot(random);
    const std::string model = robot.model(std::exp(random.between(0.0, 3.3)), GetParam());
    const Finding box = ask(model, "box"), pose = ask(model, "pose");
    if (box.verdict == Verdict::kNoSingularity) {
      EXPECT_EQ(pose.verdict, Verdict::kNoSingularity) << model;
    }
    if (pose.verdict == Verdict::kSingularity) {
      EXPECT_NE(box.verdict, Verdict::kNoSingularity) << model;
    }
    if (pose.verdict == Verdict::kPossibleProblem) {
      EXPECT_EQ(pose.result.reason, Reason::kUncertainty) << model;
    } else {
      EXPECT_NE(box.verdict, Verdict::kPossibleProblem) << model;
    }
  }
}

/// Base and platform of radius 150 and 100 mm, half angles 12° and 15°, 280 mm apart. In balls of
/// 25.41 mm, and in boxes of ±17.25 mm, anchors make it singular.
std::string desktop_hexapod(const std::string& shape, const std::string& tolerance) {
  const auto ring = [](const char* radius, const std::vector<int>& degrees) {
    std::string points;
    for (const int angle : degrees) {
      const std::string of = std::string("(") + std::to_string(angle) + "*deg)\", ";
      points += std::string(points.empty() ? "[" : ", [") + "\"" + radius + "*cos" + of + "\"" +
                radius + "*sin" + of + "0]";
    }
    return "[" + points + "]";
  };
  return "regulus = 1\nname = \"desktop hexapod\"\n[gough]\norientation = \"roll-pitch-yaw\"\n"
         "unit = \"mm\"\nbase = " +
         ring("150", {-12, 12, 108, 132, 228, 252}) +
         "\nplatform = " + ring("100", {-45, 45, 75, 165, 195, 285}) +
         "\nbase_tolerance = " + tolerance + "\nplatform_tolerance = " + tolerance +
         "\ntolerance_shape = \"" + shape +
         "\"\n[motion.pose]\nx = 0\ny = 0\nz = 280\nroll = 0\npitch = 0\nyaw = 0\n";
}

TEST_P(SinglePose, IsCertifiedCloseToTheLimit) {
  const bool ball = GetParam() == std::string("ball");
  const Finding near = ask(desktop_hexapod(GetParam(), ball ? "24.6" : "16.7"), "pose");
  EXPECT_EQ(near.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(near.result.statistics.boxes, 1U);
  const Finding beyond = ask(desktop_hexapod(GetParam(), ball ? "25.5" : "17.3"), "pose");
  EXPECT_EQ(beyond.verdict, Verdict::kSingularity);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SinglePose, testing::Values("box", "ball"),
                         [](const auto& shape) { return std::string(shape.param); });

}  // namespace
}  // namespace regulus::detail::test
