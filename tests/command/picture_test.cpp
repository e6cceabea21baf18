// SPDX-License-Identifier: GPL-3.0-or-later
// Tests pictures of pavings: gnuplot draws them, and no text is a command for it.
#include "codegen/answer/picture/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "codegen/answer/picture/canvas.hpp"
#include "codegen/answer/picture/gnuplot.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class PictureFile : public testing::Test {
 protected:
  std::string draw(const std::string& name, std::vector<std::string> words) {
    const std::filesystem::path path = folder_.path() / name;
    words.insert(words.begin(), {kCommand, "locate"});
    words.insert(words.end(), {"--picture", path.string(), "--output", "/dev/null"});
    result_ = run_command(words);
    return file_contents(path);
  }
  TemporaryDirectory folder_;
  CommandResult result_;
};

TEST_F(PictureFile, ShowsAPlaneWithItsUnitsAndLegend) {
  const std::string svg =
      draw("plane.svg", {kPlanar, "crossing", "--range", "x=0", "--axes", "y,phi"});
  EXPECT_EQ(result_.exit_code, 1);
  EXPECT_THAT(svg, AllOf(HasSubstr("planar 3-RPR, crossing"), HasSubstr("x = 0"),
                         HasSubstr("phi (deg)"), HasSubstr("<title>planar 3-RPR, crossing</title>"),
                         HasSubstr("free "), HasSubstr("singular ")));
  EXPECT_LT(svg.size(), 60000u);
}

TEST_F(PictureFile, SaysWhichRangesAreProjected) {
  const std::string svg = draw("projected.svg", {kPlanar, "crossing", "--resolution", "1/8"});
  EXPECT_THAT(svg, HasSubstr("phi in [−15, 60] deg: the worst of them"));
}

TEST_F(PictureFile, ShowsTheDeterminantOverATrajectory) {
  const std::string svg = draw("path.svg", {kRobot1, "T2"});
  EXPECT_EQ(result_.exit_code, 0);
  EXPECT_THAT(svg, AllOf(HasSubstr("robot 1, T2"), HasSubstr("determinant of the matrix"),
                         HasSubstr("free 100 %")));
}

TEST_F(PictureFile, HasNoDeterminantWhereTheMatrixHasNone) {
  const std::string path = (folder_.path() / "redundant.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"redundant\"\nsource = \"a test\"\n"
                         "[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x\"], [\"x - 1\"]]\n"
                         "[motion.m]\nx = [-1, 2]\n";
  const std::string svg = draw("redundant.svg", {path});
  EXPECT_EQ(result_.exit_code, 0) << result_.errors;
  EXPECT_THAT(svg, AllOf(HasSubstr("free 100 %"), Not(HasSubstr("determinant"))));
}

TEST_F(PictureFile, MayBeAPng) {
  const std::string png = draw("plane.png", {kPlanar, "crossing", "--range", "phi=25*deg"});
  EXPECT_THAT(png, StartsWith("\x89PNG"));
}

TEST_F(PictureFile, MayBeAPdf) {
  const std::string pdf = draw("plane.pdf", {kPlanar, "crossing", "--range", "phi=25*deg"});
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
}

TEST_F(PictureFile, ShowsSlicesSideBySide) {
  const std::string svg = draw("slices.svg", {kPlanar, "crossing", "--resolution", "1/8",
                                              "--slices", "phi=4", "--axes", "y,x"});
  EXPECT_EQ(result_.exit_code, 1) << result_.errors;
  EXPECT_THAT(svg,
              AllOf(HasSubstr("phi = −5.625 deg"), HasSubstr("phi = 50.625 deg"), HasSubstr(">y<"),
                    HasSubstr("parts of the 3-D volume"), Not(HasSubstr("the worst of"))));
}

TEST_F(PictureFile, ShowsWhichShareIsFree) {
  const std::string svg =
      draw("share.svg", {kPlanar, "crossing", "--resolution", "1/8", "--shade", "share"});
  EXPECT_THAT(svg, AllOf(HasSubstr("half free"), HasSubstr("the part that is free")));
}

TEST_F(PictureFile, MayHoldBoxesInSpace) {
  const std::string grid =
      draw("boxes.vtu", {kPlanar, "crossing", "--resolution", "1/4", "--max-boxes", "8"});
  EXPECT_THAT(grid, AllOf(HasSubstr("<VTKFile type=\"UnstructuredGrid\""),
                          HasSubstr("z is phi rad"), HasSubstr("Name=\"claim\"")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

/// Gnuplot reports nothing about what it could not write.
TEST_F(PictureFile, IsWholeOrNotThere) {
  for (const std::string name : {"part.svg", "part.png", "part.pdf"}) {
    const std::string file = (folder_.path() / name).string();
    const CommandResult result = run_command({"/bin/sh", "-c",
                                              "ulimit -f 4; exec \"$0\" locate \"$1\" crossing "
                                              "--quiet --output /dev/null --picture \"$2\"",
                                              kCommand, kPlanar, file});
    EXPECT_EQ(result.exit_code, 74);
    EXPECT_THAT(result.errors, HasSubstr("gnuplot did not finish " + file));
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST_F(PictureFile, DoesNotDependOnTheSettingsOfTheUser) {
  const std::string usual = draw("usual.svg", {kPlanar, "crossing"});
  std::ofstream(folder_.path() / ".gnuplot") << "set output '/dev/null'\n";
  const std::string file = (folder_.path() / "own.svg").string();
  EXPECT_EQ(run_command({"/usr/bin/env", "HOME=" + folder_.path().string(), kCommand, "locate",
                         kPlanar, "crossing", "--quiet", "--picture", file})
                .exit_code,
            1);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(), usual);
}

TEST_F(PictureFile, MayHaveAnyNameInIt) {
  const std::string path = (folder_.path() / "name.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"'a''b]]><c>'&\"\nsource = \"a test\"\n"
                         "[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x\"], [\"x - 1\"]]\n"
                         "[motion.m]\nx = [-1, 2]\n";
  const std::string svg = draw("name.svg", {path});
  EXPECT_EQ(result_.exit_code, 0) << result_.errors;
  EXPECT_THAT(svg, AllOf(HasSubstr("'a''b]]"), Not(HasSubstr("b]]>"))));
  EXPECT_THAT(draw("name.png", {path}), StartsWith("\x89PNG"));
}

/// A bead on a rail between two pulleys. It is held where |x| < 0.6, whatever y is.
constexpr const char* kHeld = R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
y = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
[load.push]
force = [[-2, 2]]
[actuators]
force = [1, 9]
force_unit = "kN"
[motion.line]
x = [-1, 1]
y = 1
[motion.area]
x = [-1, 1]
y = [0, 2]
[motion.way]
waypoints = "way.csv"
)toml";

class PictureOfALoad : public PictureFile {
 protected:
  PictureOfALoad() {
    std::ofstream(model_) << kHeld;
    std::ofstream(folder_.path() / "way.csv") << "t [s],x [m],y [m]\n0,0,1\n1,0.9,1\n3,0.3,1\n";
  }
  const std::string model_ = folder_.path() / "held.toml";
};

TEST_F(PictureOfALoad, HasTheColoursOfAPaving) {
  const std::string area =
      draw("area.svg", {model_, "area", "--load", "push", "--resolution", "1/64"});
  EXPECT_EQ(result_.exit_code, 1) << result_.errors;
  EXPECT_THAT(area, AllOf(HasSubstr("bead, area, load push"), HasSubstr("feasible 5"),
                          HasSubstr("infeasible 3"), HasSubstr("x (m)"), HasSubstr("y (m)"),
                          HasSubstr("rgb( 86, 180, 233)"), HasSubstr("rgb(213,  94,   0)")));
  EXPECT_THAT(area, Not(HasSubstr("singular")));
  const std::string line = draw("line.svg", {model_, "line", "--load", "push"});
  EXPECT_THAT(line, AllOf(HasSubstr("feasible 59.77 %"), Not(HasSubstr("determinant"))));
  EXPECT_THAT(draw("share.svg", {model_, "area", "--load", "push", "--shade", "share"}),
              HasSubstr("half feasible"));
}

/// The bead leaves |x| < 0.6 at t = 2/3 s, and comes back at t = 2 s: 5/9 of the time are held.
TEST_F(PictureOfALoad, HasARowForEachSegment) {
  const std::string way = draw("way.svg", {model_, "way", "--load", "push"});
  EXPECT_EQ(result_.exit_code, 1) << result_.errors;
  EXPECT_THAT(
      way, AllOf(HasSubstr("bead, way, load push"), HasSubstr("part of the segment"),
                 HasSubstr("1, t = 0 s"), HasSubstr("2, t = 1 s"), HasSubstr("parts of the time"),
                 HasSubstr("feasible 55."), HasSubstr("infeasible 44.")));
  EXPECT_THAT(draw("way.png", {model_, "way", "--load", "push"}), StartsWith("\x89PNG"));
}

TEST_F(PictureFile, RefusesWhatCannotBeDrawn) {
  const auto refused = [this](const std::string& file, std::vector<std::string> words) {
    EXPECT_EQ(draw(file, std::move(words)), "");
    EXPECT_EQ(result_.exit_code, 64);
    return result_.errors;
  };
  EXPECT_THAT(refused("p.vtu", {kPlanar, "crossing", "--range", "phi=0"}),
              HasSubstr("boxes in space need three motion parameters with ranges; this motion has "
                        "ranges of x, y; --range phi=LO:HI gives another"));
  EXPECT_THAT(refused("p.vtu", {kRobot1, "wide_15"}),
              HasSubstr("x, y, z, psi, theta, phi; --range p=V sets a parameter to one value"));
  EXPECT_THAT(refused("p.svg", {model_path("rump"), "point"}),
              HasSubstr("this motion has none; --range x=LO:HI gives one"));
  EXPECT_THAT(refused("p.svg", {kRobot1, "T1", "--slices", "T=3"}),
              HasSubstr("this motion has a range of T; name a motion with more of them"));
  EXPECT_THAT(refused("p.svg", {kPlanar, "crossing", "--slices", "phi=1"}),
              HasSubstr("expected p=N"));
  EXPECT_THAT(refused("p.svg", {kPlanar, "crossing", "--slices", "psi=4"}),
              HasSubstr("'psi' is not a parameter with a range; choose one of: x, y, phi"));
  EXPECT_THAT(refused("p.svg", {kPlanar, "crossing", "--slices", "phi=4", "--axes", "x,phi"}),
              HasSubstr("choose two of: x, y"));
  EXPECT_THAT(refused("p.svg", {kPlanar, "crossing", "--shade", "shares"}), HasSubstr("share"));
  EXPECT_THAT(refused("p.eps", {kPlanar, "crossing"}), HasSubstr(".svg, .pdf, .png or .vtu"));
}

TEST_F(PictureFile, IsDrawnOfAnInterruptedSearchToo) {
  const std::string svg =
      draw("part.svg", {kPlanar, "crossing", "--range", "x=0", "--max-boxes", "50"});
  EXPECT_THAT(svg, AllOf(HasSubstr("undecided"), HasSubstr("</svg>")));
}

TEST_F(PictureFile, MeansNothingByTheNamesInIt) {
  const std::string path = (folder_.path() / "model.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"a 'name' `touch evil` $(touch evil) @x\"\n"
                         "source = \"a test\"\n[pose]\nx = \"%s{x}\"\n[matrix]\nrows = [[\"x\"]]\n"
                         "[motion.m]\nx = [1, 2]\n";
  const std::string svg = draw("names.svg", {path});
  EXPECT_EQ(result_.exit_code, 0) << result_.errors;
  EXPECT_THAT(svg, HasSubstr("`touch evil` $(touch evil) @x"));
  EXPECT_FALSE(std::filesystem::exists("evil"));
}

TEST_F(PictureFile, NeedsGnuplotAndSaysWhereToGetIt) {
  const CommandResult result =
      run_command({"/usr/bin/env", "PATH=" + folder_.path().string(), kCommand, "locate", kPlanar,
                   "regular", "--picture", (folder_.path() / "p.svg").string()});
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_EQ(result.output, "");
  EXPECT_THAT(result.errors, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "p.svg"));
}

TEST(Gnuplot, QuotesSoThatNothingHasAMeaning) {
  EXPECT_EQ(Gnuplot::quoted("it's\n$x"), "'it'.quote.'s$x'");
}

TEST(Gnuplot, ReportsItsComplaint) {
  const TemporaryDirectory folder;
  Gnuplot gnuplot((folder.path() / "p.svg").string());
  try {
    gnuplot.draw("plot nonsense(\n", "");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("could not draw"), HasSubstr("nonsense")));
  }
}

std::string text_of_picture(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Gnuplot, LeavesThePictureThatWasThereUntilItHasAnother) {
  const TemporaryDirectory folder;
  const auto file = folder.path() / "p.svg";
  std::ofstream(file) << "an earlier picture, longer than what is drawn now";
  { const Gnuplot gnuplot(file.string()); }
  EXPECT_THAT(text_of_picture(file), HasSubstr("an earlier picture"));
  Gnuplot(file.string()).draw("set terminal svg\nplot x\n", "x < y & z");
  EXPECT_THAT(text_of_picture(file), testing::Not(HasSubstr("picture")));
  EXPECT_THAT(text_of_picture(file),
              AllOf(HasSubstr("<title>x &lt; y &amp; z</title>"), HasSubstr("</svg>")));
}

TEST(Gnuplot, LeavesNoFileWithoutAPicture) {
  const TemporaryDirectory folder;
  const auto file = folder.path() / "p.svg";
  { const Gnuplot gnuplot(file.string()); }
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// A canvas over the unit square, 4 by 4 tiles.
class CanvasTest : public testing::Test {
 protected:
  CanvasTest() {
    preparation_.variety.outer = {{0, 1}, {0, 1}, {0, 1}};
    options_.paving.resolution = 0.25;
    options_.paving.axes = {0, 1, 2};
    options_.drawn = {0, 1};
  }
  void paint(std::vector<Interval> box, Rule rule) { canvas().on_leaf({0, 0, box}, rule, {}); }
  Canvas& canvas() {
    if (!canvas_) canvas_.emplace(preparation_, options_);
    return *canvas_;
  }
  PreparedSearch preparation_;
  PictureOptions options_;
  std::optional<Canvas> canvas_;
};

TEST_F(CanvasTest, ShowsTheWorstOfAllBoxesOverATile) {
  paint({{0, 1}, {0, 1}, {0, 0.5}}, Rule::kHMatrix);
  paint({{0, 0.5}, {0, 1}, {0.5, 1}}, Rule::kOutside);
  paint({{0.5, 0.75}, {0, 1}, {0.5, 1}}, Rule::kBlocked);
  paint({{0.5, 0.75}, {0, 0.25}, {0.5, 1}}, Rule::kWitness);
  EXPECT_EQ(canvas().claim(1, 2), Claim::kFree);
  EXPECT_EQ(canvas().claim(2, 1), Claim::kUndecided);
  EXPECT_EQ(canvas().claim(2, 0), Claim::kSingular);
  EXPECT_EQ(canvas().claim(3, 3), Claim::kFree);
}

TEST_F(CanvasTest, ShowsNothingAsFreeThatNoBoxReached) {
  EXPECT_EQ(canvas().claim(0, 0), Claim::kUndecided);
}

TEST_F(CanvasTest, OfASliceShowsTheBoxesThatItMeets) {
  canvas_.emplace(preparation_, options_, Slice{2, 0.75});
  paint({{0, 1}, {0, 1}, {0, 0.5}}, Rule::kBlocked);
  paint({{0, 1}, {0, 1}, {0.5, 0.75}}, Rule::kHMatrix);
  paint({{0, 0.25}, {0, 1}, {0.75, 1}}, Rule::kOutside);
  EXPECT_EQ(canvas().claim(0, 0), Claim::kFree);
  EXPECT_EQ(canvas().claim(3, 3), Claim::kFree);
}

TEST_F(CanvasTest, HasTheFreeShareOfTheVolumeOverATile) {
  options_.shade = Shade::kShare;
  paint({{0, 1}, {0, 1}, {0, 0.5}}, Rule::kHMatrix);
  paint({{0, 0.375}, {0, 1}, {0.5, 1}}, Rule::kBlocked);
  paint({{0.375, 1}, {0, 1}, {0.5, 1}}, Rule::kOutside);
  EXPECT_DOUBLE_EQ(canvas().free_share(0, 0), 0.5);
  EXPECT_DOUBLE_EQ(canvas().free_share(1, 0), 2.0 / 3);
  EXPECT_DOUBLE_EQ(canvas().free_share(3, 3), 1.0);
}

TEST_F(CanvasTest, HasNoShareWhereEverythingIsOutside) {
  options_.shade = Shade::kShare;
  paint({{0, 1}, {0, 1}, {0, 1}}, Rule::kOutside);
  EXPECT_LT(canvas().free_share(2, 2), 0);
}

TEST_F(CanvasTest, CoversEveryTileOfAKindOnce) {
  paint({{0, 1}, {0, 1}, {0, 1}}, Rule::kHMatrix);
  paint({{0.25, 0.75}, {0.25, 0.5}, {0, 1}}, Rule::kWitness);
  paint({{0.75, 1}, {0.5, 1}, {0, 1}}, Rule::kWitness);
  for (const Claim claim : {Claim::kFree, Claim::kSingular}) {
    std::vector<int> covered(16);
    for (const TileRectangle& r : canvas().rectangles(claim))
      for (std::size_t row = r.bottom; row < r.top; ++row)
        for (std::size_t column = r.left; column < r.right; ++column) ++covered[4 * row + column];
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        EXPECT_EQ(covered[4 * row + column], canvas().claim(column, row) == claim)
            << column << ' ' << row;
  }
}

}  // namespace
}  // namespace regulus::detail::test
