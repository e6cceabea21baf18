// SPDX-License-Identifier: GPL-3.0-or-later
// A certificate depends only on the model file and the options. Addresses and times differ from
// process to process and must not matter.
#include <gtest/gtest.h>

#include "tests/support/cached_command.hpp"

namespace regulus::test {
namespace {

struct AskedTwice {
  std::string name;
  std::string model;
  std::vector<std::string> options;
};

class ACertificateFile : public testing::TestWithParam<AskedTwice> {
 protected:
  /// Returns the bytes that a new process writes.
  [[nodiscard]] std::string written(const std::vector<std::string>& more = {}) const {
    const std::string path = (directory_.path() / "certificate").string();
    std::filesystem::remove(path);
    std::vector<std::string> words = {
        kCommand, "check", REGULUS_SOURCE_DIR + GetParam().model, "--quiet", "--certificate", path};
    words.insert(words.end(), GetParam().options.begin(), GetParam().options.end());
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult result = run_command(words);
    EXPECT_LE(result.exit_code, 1) << result.errors;
    return file_contents(path);
  }

  const TemporaryDirectory directory_;
};

TEST_P(ACertificateFile, HasTheSameBytesInEveryProcess) {
  const std::string first = written();
  EXPECT_NE(first.find("\nproof\n"), std::string::npos);
  for (int process = 0; process < 4; ++process) ASSERT_EQ(written(), first);
}

TEST_P(ACertificateFile, DoesNotDependOnWhatTheSearchRanOn) {
  const std::string first = written();
  EXPECT_EQ(written({"--threads", "2"}), first);
  EXPECT_EQ(written({"--isa", "portable"}), first);
  EXPECT_EQ(written({"--engine", "interpreted"}), first);
  EXPECT_EQ(written({"--engine", "jit", "--no-cache"}), first);
  EXPECT_EQ(written({"--engine", "clang"}), first) << "the reference of all others";
}

TEST_P(ACertificateFile, DoesNotDependOnWhatTheCacheHolds) {
  std::string first;
  for (const char* threads : {"1", "2", "8"})
    for (const char* engine : {"interpreted", "auto", "jit"}) {
      const CachedCommand empty;
      const std::vector<std::string> more = {"--engine", engine, "--threads", threads};
      const std::string cold = written(more);
      if (first.empty()) first = cold;
      EXPECT_EQ(cold, first) << engine << ", cold, " << threads;
      EXPECT_EQ(written(more), first) << engine << ", warm, " << threads;
      for (const auto& object : empty.objects()) std::filesystem::remove(object);
      EXPECT_EQ(written({"--engine", "auto"}), first) << "from what " << engine << " has left";
    }
}

const std::string kFirstRobot = "/models/robot_1.toml", kSecondRobot = "/models/robot_2.toml";

INSTANTIATE_TEST_SUITE_P(
    Models, ACertificateFile,
    testing::Values(
        AskedTwice{"SingularWorkspace", kFirstRobot, {"wide_40"}},
        AskedTwice{"Trajectory", kFirstRobot, {"T2_errors", "--tolerance", "base,platform=0.05"}},
        AskedTwice{"Threshold", kFirstRobot, {"table4_5", "--alpha", "1/2*sqrt(2)"}},
        AskedTwice{"Tolerances", kSecondRobot, {"table5_20", "--tolerance", "base,platform=20"}},
        AskedTwice{"Planar", "/models/planar_3rpr.toml", {"regular"}},
        AskedTwice{"Point", "/models/rump.toml", {"point"}}),
    [](const auto& asked) { return asked.param.name; });

}  // namespace
}  // namespace regulus::test
