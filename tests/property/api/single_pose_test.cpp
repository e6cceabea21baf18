// SPDX-License-Identifier: GPL-3.0-or-later
// Random hexapods with uncertain anchors, at single poses and in small boxes around them.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/api/regulus.hpp"
#include "tests/support/random_hexapod.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
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
  for (int trial = 0; trial < 12; ++trial) {
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
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SinglePose, testing::Values("box", "ball"),
                         [](const auto& shape) { return std::string(shape.param); });

}  // namespace
}  // namespace regulus::test
