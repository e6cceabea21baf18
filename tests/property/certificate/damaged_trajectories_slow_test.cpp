// SPDX-License-Identifier: GPL-3.0-or-later
// A hundred thousand damaged files of way-points and of G-code: each is read, or refused with its
// line. The verifier has readers of its own; what both read is the same path.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "codegen/model/exact/real_functions.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/gcode.hpp"
#include "runtime/verifier/model/waypoints.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

constexpr unsigned kFiles = 100'000;

constexpr const char* kGantry = R"(regulus = 1
name = "gantry"
[pose]
x = "mm"
y = "mm"
z = "mm"
[matrix]
rows = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
[motion.held]
x = 0
y = 0
z = 0
)";

const std::vector<std::string> kTables = {
    "t [s],x [mm],y [mm],z [mm]\n0,0,0,5\n0.5,10,1.5,5\n# a comment\n1.25,20,-3,6\n2,30,4e-1,5\n",
    "\xEF\xBB\xBFx;y;z\r\n1;2;3\r\n4;5;6\r\n7;8;9\r\n",
    "time\tx [m]\ty [cm]\tz\tdx\tdy\tdz\n0\t0\t0\t1\t0\t0\t0\n1\t0.01\t1\t1\t1\t1\t0\n",
    "\"x\",\"y\",note\n0,0,1\n1,1,2\n2,4,3\n"};

const std::vector<std::string> kPrograms = {
    "%\n(square)\nG21 G90\nG0 X0 Y0 Z5\nG1 X10 F100\nY10\nX0\nY0\nM30\n",
    "N10 G20 G17\nN20 G0 X1 Y0 Z.5\nN30 G3 X-1 Y0 I-1 J0\nN40 G2 X1 I1\nG91\nG1 Z-.25\nM2\n",
    "g0 x0 y5 z10 g18\ng2 z0 x10 k-10 ; arc\ng3 x0 z10 i-10 k.001\ng19 g90.1 g3 y15 z0 j5 k10\n"};

const std::vector<std::string> kSplices = {
    ",",   ";",   "\t",  "\n",  "\r",   "\"",    "[",         "]",     "-",     "+",
    ".",   "0",   "1",   "9",   "e5",   "E-3",   "nan",       "inf",   "1e999", "1e-999",
    "x",   "y",   "dx",  "t",   "time", "[mm]",  "[furlong]", "#",     "\xff",  " ",
    "G0",  "G1",  "G2",  "G3",  "G5",   "G17",   "G18",       "G19",   "G20",   "G21",
    "G28", "G43", "G54", "G90", "G91",  "G90.1", "G91.1",     "G4 P1", "M2",    "M30",
    "X",   "Y1",  "Z",   "I1",  "J-2",  "K",     "R5",        "A90",   "(",     ")",
    "%",   "/",   "N5",  "F",   "--",   "1.2.3", "2,4",       "x,x"};

struct Counts {
  unsigned read = 0, refused = 0, with_line = 0, compared = 0;
};

class DamagedTrajectories : public testing::Test {
 protected:
  /// Any exception but InputError escapes and fails the test.
  std::optional<Trajectory> read(const std::string& text, const std::string& ending,
                                 const std::string& interpolation) try {
    const std::string file = (folder_.path() / ("way" + ending)).string();
    std::ofstream(file, std::ios::binary) << text;
    Motion motion = model_.motions.front();
    motion.waypoints = WaypointSource{file, "way", interpolation};
    load_trajectory(model_, motion);
    EXPECT_FALSE(motion.trajectory->pieces.empty());
    ++counts_.read;
    return *motion.trajectory;
  } catch (const InputError& error) {
    const std::string why = error.what();
    EXPECT_NE(why.find("way" + ending), std::string::npos) << why;
    ++counts_.refused;
    counts_.with_line += why.find("way" + ending + ":") != std::string::npos;
    return std::nullopt;
  }

  void expect_counts() const {
    EXPECT_EQ(counts_.read + counts_.refused, kFiles);
    EXPECT_GT(counts_.read, kFiles / 50);
    EXPECT_GT(counts_.with_line, kFiles / 20);
    EXPECT_GT(counts_.compared, kFiles / 50);
    std::cout << counts_.read << " read, " << counts_.refused << " refused, " << counts_.with_line
              << " of them with a line, " << counts_.compared << " compared\n";
  }

  TemporaryDirectory folder_;
  const Model model_ = parse_model(kGantry, "gantry.toml");
  Counts counts_;
};

double place(const Trajectory& trajectory, std::size_t piece, std::size_t axis, double s) {
  const GiNaC::ex at = expression_of(trajectory.pieces[piece].pose[axis], GiNaC::numeric(s));
  return GiNaC::ex_to<GiNaC::numeric>(at.evalf()).to_double();
}

double place(const verifier::ProgramMove& move, std::size_t axis, double s) {
  verifier::Graph graph;
  const verifier::NodeId root = verifier::place_on_move(graph, move, axis);
  const std::vector<verifier::Ball> at(1, verifier::Ball(verifier::point(s), 256));
  const auto value = verifier::evaluate(graph, {root}, at, 256);
  return value ? mid((*value)[0].enclosure()) : NAN;
}

TEST_F(DamagedTrajectories, OfGcodeAreRefusedOrReadInOneWay) {
  for (unsigned seed = 0; seed < kFiles; ++seed) {
    const std::string text = Damage(seed, kSplices).done_to(kPrograms[seed % kPrograms.size()]);
    SCOPED_TRACE(text);
    const auto trajectory = read(text, ".nc", "linear");
    std::vector<verifier::ProgramMove> moves;
    try {
      moves = verifier::read_program(text);
    } catch (const verifier::Unfinished&) {
      continue;  // the verifier may know less
    }
    if (!trajectory) continue;  // more is refused to a user, for example a radius of 0
    ASSERT_EQ(moves.size(), trajectory->pieces.size());
    ++counts_.compared;
    if (seed % 16 != 0) continue;
    for (std::size_t k = 0; k < moves.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double s : {0.125, 0.375, 1.0}) {
          const double expected = place(*trajectory, k, axis, s);
          ASSERT_NEAR(place(moves[k], axis, s), expected, 1e-9 * (1 + std::fabs(expected)));
        }
  }
  expect_counts();
}

TEST_F(DamagedTrajectories, OfTablesAreRefusedOrReadInOneWay) {
  for (unsigned seed = 0; seed < kFiles; ++seed) {
    const char* const interpolation = seed % 3 == 0   ? "linear"
                                      : seed % 3 == 1 ? "cubic"
                                                      : "hermite";
    const std::string text = Damage(seed, kSplices).done_to(kTables[seed / 3 % kTables.size()]);
    SCOPED_TRACE(text);
    const auto trajectory = read(text, ".csv", interpolation);
    verifier::WaypointTable table;
    try {
      table = verifier::read_waypoint_table(text);
    } catch (const verifier::Unfinished&) {
      continue;
    }
    if (!trajectory) continue;
    ASSERT_EQ(table.rows.size(), trajectory->pieces.size() + 1);
    ++counts_.compared;
  }
  expect_counts();
}

}  // namespace
}  // namespace regulus::detail::test
