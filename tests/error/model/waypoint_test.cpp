// SPDX-License-Identifier: GPL-3.0-or-later
// Files of way-points that are refused: each with its line, and what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/model/way/trajectory.hpp"
#include "tests/error/model/refusal.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kModel = R"toml(regulus = 1
name = "cart"
[pose]
x = "m"
phi = "deg"
[matrix]
rows = [["x", "sin(phi)"], ["1", "cos(phi)"]]
[motion.held]
x = 1
phi = 0
[motion.box]
x = [0, 1]
phi = [0, 1]
)toml";

/// Returns the pieces of a file, along a motion that holds the pose parameters without a column.
Trajectory read(const std::string& text, const std::string& ending = ".csv",
                const std::string& motion_name = "held",
                const std::string& interpolation = "linear",
                const std::string& model_text = kModel) {
  const TemporaryDirectory folder;
  const std::string file = (folder.path() / ("way" + ending)).string();
  std::ofstream(file, std::ios::binary) << text;
  const Model model = parse_model(model_text, "m.toml");
  Motion motion;
  for (const Motion& m : model.motions)
    if (m.name == motion_name) motion = m;
  motion.waypoints = WaypointSource{file, "way" + ending, interpolation};
  load_trajectory(model, motion);
  return *motion.trajectory;
}

std::string refusal(const std::string& text, const std::string& ending = ".csv",
                    const std::string& motion = "held",
                    const std::string& interpolation = "linear") try {
  static_cast<void>(read(text, ending, motion, interpolation));
  return "accepted";
} catch (const InputError& error) {
  return error.what();
}

TEST(Waypoints, HaveALineOfNames) {
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("0,1\n1,2\n"), HasSubstr(":1: the first line has a number"));
  EXPECT_THAT(refusal("x [m\n1\n2\n"), HasSubstr("open bracket"));
  EXPECT_THAT(refusal("x,x\n1,1\n2,2\n"), HasSubstr("two columns are named 'x'"));
}

TEST(Waypoints, AreAtLeastTwo) {
  EXPECT_THAT(refusal("x\n"), HasSubstr("there are no way-points"));
  EXPECT_THAT(refusal("x\n1\n"), HasSubstr(":2: there is only one way-point"));
}

TEST(Waypoints, HaveANumberInEachColumn) {
  EXPECT_THAT(refusal("x,phi\n1,2\n1\n"), HasSubstr(":3: this line has 1 cells"));
  EXPECT_THAT(refusal("x,phi\n1,2\nnan,3\n"), HasSubstr(":3: the cell 'nan' of column 'x'"));
  EXPECT_THAT(refusal("x,phi\n1,2\ninf,3\n"), HasSubstr("finite decimal number"));
  EXPECT_THAT(refusal("x,phi\n1,2\n,3\n"), HasSubstr(":3: the cell of column 'x' is empty"));
  EXPECT_THAT(refusal("x,phi\n1,2\n1.2.3,3\n"), HasSubstr("is not a number"));
}

TEST(Waypoints, HaveNoDecimalCommas) {
  EXPECT_THAT(refusal("x;phi\n1,5;2\n2;3\n"),
              HasSubstr(":2: the cell '1,5' of column 'x' has a decimal comma; write a decimal "
                        "point: 1.5"));
  EXPECT_THAT(refusal("x,phi\n1,5,2,5\n"), HasSubstr("may have decimal commas"));
}

TEST(Waypoints, HaveIncreasingTimes) {
  EXPECT_THAT(refusal("t,x\n0,1\n1,2\n1,3\n"), HasSubstr(":4: the time is that of line 3"));
  EXPECT_THAT(refusal("t,x\n0,1\n1,2\n0.5,3\n"),
              HasSubstr(":4: the time is before that of line 3"));
}

TEST(Waypoints, GiveEveryPoseParameterAValue) {
  EXPECT_THAT(refusal("x\n1\n2\n", ".csv", "box"),
              HasSubstr(":1: nothing gives the pose parameter 'phi' a value; add a column 'phi'"));
  EXPECT_THAT(refusal("x,phii\n1,2\n2,3\n"), HasSubstr("did you mean 'phi'?"));
}

TEST(Waypoints, HaveUnitsThatFitTheModel) {
  EXPECT_THAT(refusal("x [deg]\n1\n2\n"), HasSubstr("is in 'deg', and the model has 'm'"));
  EXPECT_THAT(refusal("x [parsec]\n1\n2\n"), HasSubstr("is in 'parsec'"));
}

TEST(Waypoints, HaveDerivativesIfTheyAreInterpolatedByThem) {
  EXPECT_THAT(refusal("x\n1\n2\n", ".csv", "held", "hermite"),
              HasSubstr("hermite needs the times"));
  EXPECT_THAT(refusal("t [s],x [m]\n0,1\n1,2\n", ".csv", "held", "hermite"),
              HasSubstr("add a column 'dx'"));
  EXPECT_THAT(refusal("t [s],x [m],dx [mm/s]\n0,1,0\n1,2,0\n", ".csv", "held", "hermite"),
              HasSubstr("write it in 'm/s'"));
}

TEST(Waypoints, AreReadWithMarksCommentsAndOtherEnds) {
  const Trajectory t = read(
      "\xEF\xBB\xBF# from the controller\r\n\r\nt [s];\"x [mm]\";phi [rad]\r\n"
      "0;+1000;0\r\n# pause\r\n0.5;.5e3;1\r\n");
  ASSERT_EQ(t.pieces.size(), 1U);
  EXPECT_EQ(t.pieces[0].first_line, 4);
  EXPECT_EQ(t.pieces[0].last_line, 6);
  EXPECT_TRUE(t.pieces[0].pose[0].power[0].is_equal(1));
  EXPECT_TRUE(t.pieces[0].pose[0].power[1].is_equal(GiNaC::numeric(-1, 2)));
  EXPECT_TRUE(t.pieces[0].pose[1].power[1].is_equal(180 / GiNaC::Pi));
}

TEST(Waypoints, AreJoinedByACurveWithContinuousSecondDerivatives) {
  const Trajectory t = read("t,x\n0,0\n1,2\n3,1\n4,5\n", ".csv", "held", "cubic");
  ASSERT_EQ(t.pieces.size(), 3U);
  const auto value = [&t](std::size_t k, int order, double s) {
    const auto& p = t.pieces[k].pose[0].power;
    const double h = GiNaC::ex_to<GiNaC::numeric>(t.pieces[k].end - t.pieces[k].begin).to_double();
    const auto c = [&p](int i) {
      return GiNaC::ex_to<GiNaC::numeric>(p[std::size_t(i)]).to_double();
    };
    if (order == 0) return c(0) + s * (c(1) + s * (c(2) + s * c(3)));
    if (order == 1) return (c(1) + s * (2 * c(2) + s * 3 * c(3))) / h;
    return (2 * c(2) + 6 * c(3) * s) / (h * h);
  };
  for (std::size_t k = 0; k + 1 < 3; ++k)
    for (int order = 0; order < 3; ++order)
      EXPECT_NEAR(value(k, order, 1), value(k + 1, order, 0), 1e-12) << k << ' ' << order;
  EXPECT_NEAR(value(0, 2, 0), 0, 1e-12);
  EXPECT_NEAR(value(2, 2, 1), 0, 1e-12);
}

TEST(Waypoints, NoteAnAngleThatJumpsByMoreThanHalfATurn) {
  const Trajectory t = read("x,phi\n1,179\n1,-179\n");
  ASSERT_EQ(t.notes.size(), 1U);
  EXPECT_THAT(t.notes[0], StartsWith("phi changes by more than half a turn between lines 2 and 3"));
}

constexpr const char* kPoint = R"(regulus = 1
name = "point"
[pose]
x = "mm"
y = "mm"
z = "mm"
[matrix]
rows = [["x", "y", "z"], ["y", "z", "1"], ["1", "x", "2"]]
[motion.held]
x = 0
y = 0
z = 0
)";

std::string gcode_refusal(const std::string& text) try {
  static_cast<void>(read(text, ".nc", "held", "linear", kPoint));
  return "accepted";
} catch (const InputError& error) {
  return error.what();
}

TEST(Gcode, HasArcsThatAreCircles) {
  const Trajectory t = read(
      "%\nN10 G21 G90 (mm)\nG0 X10 Y0 Z5\nG3 X0 Y10 I-10 J0 F100 ; a quarter\nG1 Z1\nM30\nG99\n",
      ".nc", "held", "linear", kPoint);
  ASSERT_EQ(t.pieces.size(), 2U);
  const PieceOfPose& x = t.pieces[0].pose[0];
  EXPECT_EQ(t.pieces[0].first_line, 4);
  EXPECT_TRUE(x.cosine.is_equal(10));
  EXPECT_TRUE(x.sine.is_zero());
  EXPECT_TRUE(x.power[1].is_zero());
  EXPECT_TRUE((x.turn - GiNaC::Pi / 2).is_zero()) << x.turn;
  EXPECT_TRUE(t.pieces[0].pose[1].sine.is_equal(10));
  EXPECT_TRUE(t.pieces[1].pose[2].power[1].is_equal(-4));
}

TEST(Gcode, TurnsClockwiseAndAllTheWay) {
  const auto turn_of = [](const std::string& move) {
    return read("G0 X10 Y0 Z5\n" + move + "\n", ".nc", "held", "linear", kPoint)
        .pieces.at(0)
        .pose[0]
        .turn;
  };
  EXPECT_TRUE((turn_of("G2 X10 Y0 I-10") + 2 * GiNaC::Pi).is_zero());
  EXPECT_TRUE((turn_of("G3 X10 Y0 I-10") - 2 * GiNaC::Pi).is_zero());
  EXPECT_TRUE((turn_of("G2 X0 Y10 I-10") + 3 * GiNaC::Pi / 2).expand().is_zero());
  EXPECT_TRUE((turn_of("G2 X-10 Y0 I-10") + GiNaC::Pi).is_zero());
}

TEST(Gcode, RefusesWhatItDoesNotRead) {
  EXPECT_THAT(gcode_refusal("G0 X1\nG1 X2\n"), HasSubstr("no move after x, y and z are known"));
  EXPECT_THAT(gcode_refusal("G0 X0 Y0 Z0\nG28\n"),
              HasSubstr(":2: the word G28 is not one of those that are read"));
  EXPECT_THAT(gcode_refusal("G0 X0 Y0 Z0\nG2 X1 Y1 R1\n"), HasSubstr("the radius R leaves two"));
  EXPECT_THAT(gcode_refusal("G0 X10 Y0 Z0\nG2 X0 Y12 I-10\n"),
              HasSubstr("not equally far from its centre"));
  EXPECT_THAT(gcode_refusal("G0 X0 Y0 Z0 A5\n"), HasSubstr("the axis A"));
  EXPECT_THAT(gcode_refusal("G0 X0 Y0 Z#5\n"), HasSubstr("not a letter and a number"));
  EXPECT_THAT(gcode_refusal("G91\nG1 X1 Y1 Z1\n"), HasSubstr("begins at an unknown position"));
}

/// RS274/NGC: the words of a line act in one order, and each that could move is obeyed or refused.
TEST(Gcode, MovesOnALineThatDwells) {
  for (const char* line : {"G4 P1 G1 X-5", "X-5 G4 P1", "G1 X-5 G4 P1"})
    EXPECT_EQ(read(std::string("G1 X0 Y0 Z5\n") + line + "\n", ".nc", "held", "linear", kPoint)
                  .pieces.size(),
              1U)
        << line;
}

TEST(Gcode, NamesTheWordAndTheLineThatItRefuses) {
  const auto refusal = [](const std::string& line) {
    return gcode_refusal("G0 X0 Y0 Z0\nX9\n" + line + "\nX1\n");
  };
  EXPECT_THAT(refusal("M98 P1000"), HasSubstr(":3: the word M98 calls a part of the program"));
  EXPECT_THAT(refusal("G3 I-3 P2"), HasSubstr(":3: the word P belongs to no G4; that of an arc"));
  EXPECT_THAT(refusal("G4 P2 G3 I-3"), HasSubstr(":3: the word P on the line of an arc"));
  EXPECT_THAT(refusal("G64 P.1"), HasSubstr(":3: the word G64 lets the controller round"));
  EXPECT_THAT(refusal("G1.04 X1"), HasSubstr(":3: the word G1.04 is not one of those"));
  EXPECT_THAT(refusal("M3.7"), HasSubstr(":3: the word M3.7 is not one of those"));
  EXPECT_THAT(refusal("G80 X1"), HasSubstr(":3: coordinates are given where no move is in force"));
  EXPECT_THAT(refusal("G0 G1 X1"), HasSubstr(":3: the words G0 and G1 cannot be on one line"));
  EXPECT_THAT(refusal("G2 I1 K1"),
              HasSubstr(":3: the word K is given for an arc in another plane"));
  EXPECT_THAT(refusal("G90.1 G2 X1 I1"), HasSubstr(":3: G90.1 needs both coordinates"));
  EXPECT_THAT(refusal("G1 X1 I1"), HasSubstr(":3: a straight move has no centre"));
  EXPECT_THAT(refusal("/G1 X1"), HasSubstr(":3: a line that begins with / is left out if"));
  EXPECT_THAT(refusal("G1 X1\rG1 Y1"), HasSubstr(":3: a carriage return is inside of the line"));
  EXPECT_THAT(refusal("%"), HasSubstr(":3: a line % ends a program that no line % began"));
  EXPECT_THAT(refusal("O100"), HasSubstr(":3: the word O calls, repeats or leaves out"));
  EXPECT_THAT(refusal("G4"), HasSubstr(":3: G4 has no time"));
  EXPECT_THAT(refusal("G3 Y.000001 I-3"), HasSubstr(":3: the ends of the arc are too near"));
  for (const char* line :
       {"G53 X1", "G92 X1", "G10 L2", "G43 H1", "G41 D1", "G81 R1", "G55",   "#1=5", "X[1]",
        "X1*71",  "M6",     "M104",   "E1",     "L1",     "(py,1)", "(a(b)", "G93",  "N1 N2",
        "N-1",    "X1 X2",  "F-1",    "T1.5",   "G98",    "G5",     "G68"})
    EXPECT_THAT(refusal(line), HasSubstr("way.nc:3: ")) << line;
}

TEST(Gcode, EndsWithTheSecondPercent) {
  EXPECT_EQ(read("%\nG0 X0 Y0 Z0\nX1\n%\nX2\n", ".nc", "held", "linear", kPoint).pieces.size(), 1U);
}

TEST(Gcode, SaysThatLengthsAreInMillimetresIfNothingSaysIt) {
  const auto notes = [](const std::string& unit) {
    return read(unit + "G0 X0 Y0 Z0\nX1\n", ".nc", "held", "linear", kPoint).notes;
  };
  EXPECT_THAT(notes(""), testing::Contains(HasSubstr("no G20 or G21")));
  EXPECT_THAT(notes("G21 "), testing::Not(testing::Contains(HasSubstr("no G20 or G21"))));
}

TEST(Gcode, SaysHowFarAnArcMissesItsEnd) {
  const Trajectory t =
      read("G0 X10 Y0 Z5\nG3 X0 Y10.005 I-10 J0\n", ".nc", "held", "linear", kPoint);
  EXPECT_FALSE(t.pieces[0].pose[1].power[1].is_zero());
}

TEST(WaypointMotion, HasNoRangesOrParameters) {
  const auto refused = [](const std::string& lines, const std::string& why) {
    EXPECT_THROW(
        static_cast<void>(parse_model(std::string(kModel) + "[motion.way]\n" + lines, "m")),
        InputError)
        << why;
  };
  refused("waypoints = \"w.csv\"\nx = [0, 1]\n", "range");
  refused("waypoints = \"w.csv\"\nconstraints = [\"y\"]\n", "an unknown name in a constraint");
  refused("waypoints = \"w.csv\"\nparameters = { T = [0, 1] }\n", "parameters");
  refused("waypoints = \"w.csv\"\ninterpolation = \"quintic\"\n", "interpolation");
  refused("interpolation = \"linear\"\nx = 0\nphi = 0\n", "no way-points");
}

}  // namespace
}  // namespace regulus::detail::test
