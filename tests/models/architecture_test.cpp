// SPDX-License-Identifier: GPL-3.0-or-later
// Platforms whose legs are dependent at every pose, and the effect of a tiny change.
#include <fstream>

#include "tests/models/jacobian.hpp"
#include "tests/models/shipped_model.hpp"
#include "tests/support/example_model.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

constexpr const char* kEverywhere = "the full 6×6 matrix is singular at every pose of the motion";

std::string text_of(const ShippedModel& model) {
  std::ifstream file(model.path());
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the verdict on a changed copy of the model.
std::string verdict_of(const std::string& text, std::vector<std::string> words) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "model.toml";
  std::ofstream(path) << text;
  words.insert(words.begin(), {REGULUS_BINARY_DIR "/bin/regulus", "check", path, "--quiet"});
  return run_command(words).output;
}

TEST(SimilarHexagons, AreSingularAtEveryPose) {
  const ShippedModel model("similar_hexagons");
  EXPECT_EQ(model.check({"any", "--max-boxes", "500"})["claim"], kEverywhere);
  EXPECT_EQ(model.check({"turn", "--max-boxes", "500"})["claim"], kEverywhere);
  EXPECT_EQ(model.verdict({"turn", "--tolerance", "base=0.01", "--max-boxes", "500"}),
            "singularity");
}

/// One of twelve anchors moves by ten micrometres.
TEST(SimilarHexagons, AreRegularOnATurnOnceOneAnchorIsMoved) {
  const std::string moved =
      test::changed(text_of(ShippedModel("similar_hexagons")), "[0, -25, 0]", "[0, -25.001, 0]");
  EXPECT_EQ(verdict_of(moved, {"turn"}), "NO SINGULARITY\n");
  EXPECT_EQ(verdict_of(moved, {"turn", "--tolerance", "base=0.001", "--max-boxes", "2000"}),
            "SINGULARITY\n");
}

TEST(GriffisDuffy, IsSingularAtEveryPose) {
  const ShippedModel model("griffis_duffy");
  EXPECT_EQ(model.check({"--max-boxes", "500"})["claim"], kEverywhere);
  Poses poses;
  for (int trial = 0; trial < 20; ++trial)
    EXPECT_NEAR(approx_determinant(model.matrix({{"x", poses.between(-9, 9)},
                                                 {"y", poses.between(-9, 9)},
                                                 {"z", poses.between(5, 15)},
                                                 {"roll", poses.between(-1, 1)},
                                                 {"pitch", poses.between(-1, 1)},
                                                 {"yaw", poses.between(-3, 3)}})),
                0, 1e-11);
}

TEST(GriffisDuffy, IsRegularOnATurnOnceACornerIsMoved) {
  const std::string moved =
      test::changed(text_of(ShippedModel("griffis_duffy")), "[0, 12, 0]", "[0, 12.5, 0]");
  EXPECT_EQ(verdict_of(moved, {"turn", "--max-boxes", "2000"}), "NO SINGULARITY\n");
}

}  // namespace
}  // namespace regulus::detail::test
