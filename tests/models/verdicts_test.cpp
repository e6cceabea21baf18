// SPDX-License-Identifier: GPL-3.0-or-later
// Each motion of models/*.toml has its verdict beside its name, [motion.work] # NO SINGULARITY, and
// in models/README.md: both must be the verdict of the command.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

/// Enough for every motion here; more would change nothing for a determinant that vanishes
/// everywhere.
constexpr const char* kMostBoxes = "5000";

struct Stated {
  std::string file, motion, verdict;
  bool is_solved;  ///< it is the answer of solve, not of check
};

/// Models with the motions of a paper; the tests of its tables cover them.
const std::set<std::string> kElsewhere = {"robot_1", "robot_2", "rump", "planar_3rpr"};

std::vector<Stated> stated_in_models() {
  std::vector<Stated> stated;
  for (const auto& entry : std::filesystem::directory_iterator(REGULUS_SOURCE_DIR "/models")) {
    if (entry.path().extension() != ".toml" || kElsewhere.count(entry.path().stem()) != 0) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with("[motion.")) continue;
      const std::size_t end = line.find(']'), comment = line.find("# ");
      const std::string verdict = comment == std::string::npos ? "" : line.substr(comment + 2);
      const bool is_solved = verdict.starts_with("COMPLETE");
      stated.push_back({entry.path().stem(), line.substr(8, end - 8),
                        is_solved ? verdict : verdict.substr(0, verdict.find(':')), is_solved});
    }
  }
  return stated;
}

TEST(Models, HaveTheVerdictsTheyState) {
  const std::vector<Stated> all = stated_in_models();
  EXPECT_GE(all.size(), 30U);
  for (const auto& [file, motion, verdict, is_solved] : all) {
    const CommandResult result =
        run_command({REGULUS_BINARY_DIR "/bin/regulus", is_solved ? "solve" : "check",
                     REGULUS_SOURCE_DIR "/models/" + file + ".toml", motion, "--quiet",
                     "--max-boxes", kMostBoxes});
    EXPECT_EQ(result.output, verdict + '\n') << file << ' ' << motion;
  }
}

TEST(Models, HaveTheirVerdictsInTheReadme) {
  std::ifstream file(REGULUS_SOURCE_DIR "/models/README.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const auto& [name, motion, stated, is_solved] : stated_in_models()) {
    const std::string verdict = stated.substr(0, stated.find(':'));
    const std::size_t row = text.str().find("| `" + name + "` |");
    ASSERT_NE(row, std::string::npos) << name;
    const std::string line = text.str().substr(row, text.str().find('\n', row) - row);
    std::size_t group = line.find("| " + verdict + ": ");
    if (group == std::string::npos) group = line.find("; " + verdict + ": ");
    ASSERT_NE(group, std::string::npos) << name << ' ' << verdict;
    const std::string motions = line.substr(group, line.find_first_of(";|", group + 1) - group);
    EXPECT_NE(motions.find('`' + motion + '`'), std::string::npos) << name << ' ' << motion;
  }
}

}  // namespace
}  // namespace regulus::detail::test
