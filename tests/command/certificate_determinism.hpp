// SPDX-License-Identifier: GPL-3.0-or-later
// A certificate depends only on the model file and the options. Addresses and times differ from
// process to process and must not matter.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {

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

  /// Tests what an engine writes into an empty cache, with it, and after its objects are gone.
  void expect_whatever_the_cache_holds(const std::string& engine, const std::string& threads,
                                       const std::string& first) const {
    const CachedCommand empty;
    const std::vector<std::string> more = {"--engine", engine, "--threads", threads};
    EXPECT_EQ(written(more), first) << engine << ", cold, " << threads;
    EXPECT_EQ(written(more), first) << engine << ", warm, " << threads;
    for (const auto& object : empty.objects()) std::filesystem::remove(object);
    EXPECT_EQ(written({"--engine", "auto"}), first) << "from what " << engine << " has left";
  }

  const TemporaryDirectory directory_;
};

inline const std::string kFirstRobot = "/models/robot_1.toml",
                         kSecondRobot = "/models/robot_2.toml";

inline const std::vector<AskedTwice> kAskedTwice = {
    AskedTwice{"SingularWorkspace", kFirstRobot, {"wide_40"}},
    AskedTwice{"Trajectory", kFirstRobot, {"T2_errors", "--tolerance", "base,platform=0.05"}},
    AskedTwice{"Threshold", kFirstRobot, {"table4_5", "--alpha", "1/2*sqrt(2)"}},
    AskedTwice{"Tolerances", kSecondRobot, {"table5_20", "--tolerance", "base,platform=20"}},
    AskedTwice{"Planar", "/models/planar_3rpr.toml", {"regular"}},
    AskedTwice{"Point", "/models/rump.toml", {"point"}}};

inline std::string name_of_asked(const testing::TestParamInfo<AskedTwice>& asked) {
  return asked.param.name;
}

}  // namespace regulus::detail::test
