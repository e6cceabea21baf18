// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the robot over the map of its plane, and the numbers along axes, by what gnuplot is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Returns the commands that gnuplot is given.
std::string commands_for(std::vector<std::string> words) {
  const TemporaryDirectory folder;
  const auto gnuplot = folder.path() / "gnuplot", commands = folder.path() / "commands";
  std::ofstream(gnuplot) << "#!/bin/sh\n/bin/cat >" << commands << "\necho '</svg>'\n";
  std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
  words.insert(words.begin(),
               {"/usr/bin/env", "PATH=" + folder.path().string(), kCommand, "locate"});
  words.insert(words.end(),
               {"--picture", (folder.path() / "p.svg").string(), "--output", "/dev/null"});
  EXPECT_THAT(run_command(words).errors, Not(HasSubstr("regulus:")));
  std::ifstream file(commands, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PictureOfARobot, HasItsPointsAtTheMiddleOfTheRanges) {
  const std::string text =
      commands_for({kPlanar, "regular", "--range", "phi=0", "--resolution", "1/4", "--robot"});
  // B1 is (1, 15.5), and B1B2 is along x.
  EXPECT_THAT(text,
              AllOf(HasSubstr("0 0\n15.91 0\n0 10\n0 0\nEOD"), HasSubstr("1 15.5\n18.04 15.5\n"),
                    HasSubstr("15.91 0\n18.04 15.5\nEOD"), HasSubstr("$path6")));
}

TEST(PictureOfARobot, IsRefusedWhereTheMapIsNotItsPlane) {
  for (const auto& [words, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{kRobot1, "wide_15", "--picture", "p.svg"}, "no points in a plane"},
           {{kPlanar, "crossing", "--axes", "x,phi", "--picture", "p.svg"}, "not the coordinates"},
           {{kPlanar, "crossing"}, "needs --picture"}}) {
    std::vector<std::string> all{kCommand, "locate", "--robot"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult result = run_command(all);
    EXPECT_EQ(result.exit_code, 64);
    EXPECT_THAT(result.errors, HasSubstr(why));
  }
}

TEST(PictureOfARobot, HasFewNumbersAlongItsAxes) {
  const std::string slices = commands_for(
      {kPlanar, "crossing", "--resolution", "1/4", "--slices", "y=4", "--axes", "x,phi"});
  EXPECT_THAT(slices,
              AllOf(HasSubstr("set xtics 2\n"), HasSubstr("set yrange [-15:60]\nset ytics 30\n")));
}

}  // namespace
}  // namespace regulus::test
