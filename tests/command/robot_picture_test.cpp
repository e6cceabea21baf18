// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the robot over the map of its plane, and the numbers along axes, by what gnuplot is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
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

using Place = std::array<double, 2>;
using Paths = std::vector<std::vector<Place>>;

/// Returns the points of each path that gnuplot draws.
Paths paths_in(const std::string& commands) {
  Paths paths;
  for (std::size_t at = 0; (at = commands.find("\n$path", at)) != std::string::npos; ++at) {
    std::istringstream lines(commands.substr(at + 1));
    std::string line;
    std::getline(lines, line);
    if (line.find("<<") == std::string::npos) continue;
    paths.emplace_back();
    while (std::getline(lines, line) && line != "EOD") {
      Place place{};
      std::istringstream(line) >> place[0] >> place[1];
      paths.back().push_back(place);
    }
  }
  return paths;
}

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

void expect_near(const Place& found, const Place& expected) {
  EXPECT_LT(distance(found, expected), 1e-3)
      << found[0] << ' ' << found[1] << ", expected " << expected[0] << ' ' << expected[1];
}

/// A model that a test has written; `words` are options.
std::string commands_for_text(const std::string& model, std::vector<std::string> words) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "model.toml";
  std::ofstream(path) << model;
  words.insert(words.begin(), path);
  return commands_for(words);
}

/// The same with the robot, over few boxes; `extra` are options.
std::string commands_for_model(const std::string& model, std::vector<std::string> extra) {
  extra.insert(extra.end(), {"--robot", "--resolution", "1", "--max-boxes", "8"});
  return commands_for_text(model, std::move(extra));
}

/// A crank, an actuator and a carriage, in the middle of the motion: the lengths are those of the
/// model, the sides those of the modes.
TEST(PictureOfARobot, HasCranksRailsAndRodsInThePlane) {
  const std::string text = commands_for_model(R"(regulus = 1
name = "planar stage"
[legs]
unit = "mm"
leg = [
  { type = "RRR", base = [0, 0], platform = [-30, -20], crank = 120, rod = 150, mode = "+" },
  { type = "RPR", base = [300, 0], platform = [30, -20] },
  { type = "PRR", base = [0, 300], platform = [0, 40], axis = [1, 0], rod = 160, mode = "-" }]
[motion]
work = { x = [120, 170], y = [155, 185], phi = 0 }
)",
                                              {});
  const Paths paths = paths_in(text);
  ASSERT_EQ(paths.size(), 8U);
  const auto &base = paths[0], &rail = paths[2], &crank = paths[3], &rod = paths[4];
  EXPECT_EQ(base, (std::vector<Place>{{0, 0}, {300, 0}, {0, 300}, {0, 0}}));
  EXPECT_EQ(paths[1], (std::vector<Place>{{115, 150}, {175, 150}, {145, 210}, {115, 150}}));
  expect_near(crank[0], {0, 0});
  EXPECT_NEAR(distance(crank[0], crank[1]), 120, 1e-2);
  EXPECT_NEAR(distance(rod[0], rod[1]), 150, 1e-2);
  expect_near(rod[0], crank[1]);
  expect_near(rod[1], {115, 150});
  EXPECT_GT(115 * crank[1][1] - 150 * crank[1][0], 0);  // mode "+": counterclockwise
  expect_near(rail[0], {0, 300});
  expect_near(rail[1], {145 - std::sqrt(160.0 * 160 - 90 * 90), 300});  // mode "-": the nearer one
  expect_near(paths[5][1], {145, 210});
  EXPECT_EQ(paths[6], (std::vector<Place>{{300, 0}, {175, 150}}));
  EXPECT_EQ(paths[7], (std::vector<Place>{{145, 170}}));
  // The axes are for the whole robot, the rectangles for the map.
  EXPECT_THAT(text, AllOf(HasSubstr("set xrange [-47.6"), HasSubstr("set yrange [-15:315]"),
                          HasSubstr("set size ratio -1"), HasSubstr("120 170 155 185"),
                          Not(HasSubstr("seen along"))));
}

/// Two views of legs in space have their lengths.
TEST(PictureOfARobot, HasTheLegsOfARobotInSpaceAsSeenAlongAnAxis) {
  const std::string model = R"(regulus = 1
name = "six legs of six types"
[legs]
unit = "cm"
orientation = "roll-pitch-yaw"
leg = [
  { type = "RUS", base = [10, 0, 0], platform = [3, 0, 0], axis = [0, 1, 0], crank = 6, rod = 14, mode = "+" },
  { type = "PUS", base = [0, 10, 0], platform = [0, 3, 0], axis = [0, 0, 1], rod = 9, mode = "+" },
  { type = "UPS", base = [-10, 0, 0], platform = [-3, 0, 0] },
  { type = "SPS", base = [0, -10, 0], platform = [0, -3, 0] },
  { type = "RSS", base = [7, 7, 0], platform = [2, 2, 1], axis = [1, -1, 0], crank = 6, rod = 14, mode = "-" },
  { type = "PSS", base = [-7, 7, 0], platform = [-2, 2, 1], axis = [0, 0, 1], rod = 9, mode = "-" }]
[motion.m]
x = [-1, 1]
y = [-2, 2]
z = [11, 13]
roll = 0
pitch = 0
yaw = 0
)";
  const std::string above = commands_for_model(model, {"--axes", "x,y"});
  const std::string before = commands_for_model(model, {"--axes", "x,z"});
  EXPECT_THAT(above, HasSubstr("title 'the robot, seen along z'"));
  EXPECT_THAT(before, HasSubstr("title 'the robot, seen along y'"));
  const Paths xy = paths_in(above), xz = paths_in(before);
  ASSERT_EQ(xy.size(), 13U);  // base, platform, 2 rails, 6 links, 2 actuators, the place
  ASSERT_EQ(xz.size(), xy.size());
  const auto length = [&](std::size_t path) {
    const auto &a = xy[path], &b = xz[path];
    return std::hypot(a[0][0] - a[1][0], a[0][1] - a[1][1], b[0][1] - b[1][1]);
  };
  const std::vector<double> lengths = {6, 14, 9, 6, 14, 9};
  for (std::size_t i = 0; i < lengths.size(); ++i) EXPECT_NEAR(length(4 + i), lengths[i], 1e-3);
  // Rods end at the platform: B = (0, 0, 12) + b.
  expect_near(xy[5][1], {3, 0});
  expect_near(xz[5][1], {3, 12});
  expect_near(xz[8][1], {2, 13});
  EXPECT_NEAR(length(10), std::hypot(7, 12), 1e-3);
  expect_near(xy[2][1], {0, 10});
  EXPECT_GT(xz[2][1][1], 12);  // mode "+": the farther place on the rail
  EXPECT_LT(xz[3][1][1], 13);
  EXPECT_EQ(xy.back(), (std::vector<Place>{{0, 0}}));
  EXPECT_EQ(xz.back(), (std::vector<Place>{{0, 12}}));
}

TEST(PictureOfARobot, IsThatOfAPlatformOnSixLegsFromAboveAndBefore) {
  const std::vector<std::string> words = {kRobot1,   "wide_15", "--max-boxes", "8",
                                          "--robot", "--range", "psi=0",       "--range",
                                          "theta=0", "--range", "phi=0",       "--axes"};
  std::vector<std::string> above = words, before = words;
  above.emplace_back("x,y");
  before.emplace_back("x,z");
  EXPECT_THAT(commands_for(above), HasSubstr("-9 9\n-3 7\nEOD"));
  EXPECT_THAT(commands_for(before), HasSubstr("-9 0\n-3 47.5\nEOD"));
}

/// The remedies of the messages help.
TEST(PictureOfARobot, IsRefusedWhereTheMapIsNotItsPlaceAndSaysWhatHelps) {
  const auto refused = [](const Words& words) {
    Words all{kCommand, "locate", "--robot", "--picture", "p.svg"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult result = run_command(all);
    EXPECT_EQ(result.exit_code, 64);
    return result.errors;
  };
  EXPECT_THAT(refused({kPlanar, "crossing", "--axes", "x,phi"}), HasSubstr("choose --axes x,y\n"));
  EXPECT_EQ(paths_in(commands_for(
                         {kPlanar, "crossing", "--robot", "--resolution", "1/2", "--axes", "x,y"}))
                .size(),
            6U);
  EXPECT_THAT(refused({kRobot1, "wide_15", "--axes", "z,psi"}),
              HasSubstr("choose --axes x,y or --axes x,z or --axes y,z\n"));
  EXPECT_THAT(
      refused({kPlanar, "crossing", "--slices", "x=3"}),
      HasSubstr("slices of x leave no map that is about a place of the robot; slice another"));
  EXPECT_EQ(paths_in(commands_for({kPlanar, "crossing", "--robot", "--resolution", "1/2",
                                   "--slices", "phi=2"}))
                .size(),
            12U);
  EXPECT_THAT(refused({kPlanar, "crossing", "--range", "x=0"}),
              HasSubstr("it stands in a map of x,y, which need ranges: --range x=LO:HI\n"));
  EXPECT_THAT(refused({model_path("snu_3upu"), "home"}),
              HasSubstr("a map of z,x or of z,y or of x,y, which need ranges: --range x=LO:HI\n"));
  EXPECT_THAT(commands_for({model_path("snu_3upu"), "home", "--range", "x=-5:5", "--robot",
                            "--max-boxes", "8", "--axes", "x,z"}),
              HasSubstr("seen along y"));
  EXPECT_THAT(refused({kRobot1, "T1"}), HasSubstr("no two parameters of this motion"));
  EXPECT_THAT(refused({model_path("scara"), "both_hands"}),
              HasSubstr("no two parameters of this motion"));
  EXPECT_THAT(refused({model_path("agile_eye"), "wide"}), HasSubstr("in a section [drawing]"));
  EXPECT_THAT(refused({model_path("four_bar"), "turn"}), HasSubstr("a [closure] has equations"));
  EXPECT_THAT(run_command({kCommand, "locate", "--robot", kPlanar, "crossing"}).errors,
              HasSubstr("needs --picture"));
}

TEST(PictureOfARobot, HasFewNumbersAlongItsAxes) {
  const std::string slices = commands_for(
      {kPlanar, "crossing", "--resolution", "1/4", "--slices", "y=4", "--axes", "x,phi"});
  EXPECT_THAT(slices,
              AllOf(HasSubstr("set xtics 2\n"), HasSubstr("set yrange [-15:60]\nset ytics 30\n")));
}

/// Colours that cover the map in part would be none of the legend.
TEST(PictureOfARobot, LeavesTheColoursOfTheMap) {
  const std::string text =
      commands_for({kPlanar, "regular", "--range", "phi=0", "--resolution", "1/4", "--robot"});
  EXPECT_THAT(text, AllOf(Not(HasSubstr("transparent")), Not(HasSubstr("filledcurves"))));
}

/// Returns the number behind a word that stands once.
double number_after(const std::string& commands, const std::string& word) {
  const std::size_t at = commands.find(word);
  EXPECT_TRUE(at != std::string::npos && commands.find(word, at + 1) == std::string::npos) << word;
  return std::stod(commands.substr(at + word.size()));
}

/// A map of some claims, whose legend has a text for each.
std::string commands_for_stage() {
  return commands_for_text(R"(regulus = 1
name = "planar stage"
[legs]
unit = "mm"
leg = [
  { type = "RRR", base = [0, 0], platform = [-30, -20], crank = 120, rod = 150, mode = "+", range = ["-90deg", "200deg"] },
  { type = "RPR", base = [300, 0], platform = [30, -20], range = [80, 220] },
  { type = "PRR", base = [0, 300], platform = [0, 40], axis = [1, 0], rod = 160, mode = "-", range = [0, 150] }]
[motion]
whole = { x = [0, 300], y = [0, 300], phi = 0, where = "within-ranges" }
)",
                           {"--resolution", "1/16"});
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(Legend, HasRoomForAllOfItsRows) {
  const std::string few = commands_for({kPlanar, "regular", "--range", "phi=0"});
  EXPECT_EQ(count_of(few, "keyentry"), 1U);
  EXPECT_EQ(number_after(few, "set bmargin "), 7);
  const std::string many = commands_for_stage();
  const std::size_t texts = count_of(many, "keyentry");
  EXPECT_GE(texts, 4U);
  const double columns = number_after(many, " maxcols ");
  EXPECT_EQ(number_after(many, "set bmargin "), 6 + std::ceil(double(texts) / columns));
}

/// Below many panels each text has a line of its own.
TEST(Legend, HasRoomBelowPanels) {
  const auto foot = [](std::vector<std::string> more) {
    more.insert(more.begin(), {kPlanar, "crossing", "--resolution", "1/8", "--slices", "phi=4"});
    const std::string text = commands_for(more);
    EXPECT_EQ(text.find("\nset key", text.find("\nunset key")), std::string::npos);
    return number_after(text, "margins screen 0.113,0.97,");
  };
  EXPECT_LT(foot({"--range", "x=0:0.1"}), foot({}));
}

TEST(Legend, StandsUnderTheMap) {
  EXPECT_THAT(commands_for({kPlanar, "regular", "--range", "phi=0"}),
              HasSubstr("set key at graph 0.5, screen 0.02 "));
}

/// A map of equal scales that is higher than wide has few numbers along its narrow side.
TEST(NumbersAlongAnAxis, HaveRoom) {
  const std::string text = commands_for({kPlanar, "regular", "--range", "phi=0", "--range",
                                         "x=-1:1", "--range", "y=14:18", "--resolution", "1/4"});
  EXPECT_THAT(text, AllOf(HasSubstr("set size ratio -1"), HasSubstr("set xtics 1\n"),
                          HasSubstr("set ytics 0.5\n")));
}

}  // namespace
}  // namespace regulus::detail::test
